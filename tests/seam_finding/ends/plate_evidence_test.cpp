#include "services/seam_finding/ends/plate_evidence.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "services/seam_finding/ends/constants.hpp"
#include "tests/seam_finding/ends/crossed_plate.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::crossed_plate;

TEST_CASE("a stripe says where the plate is absent: as far from the seam as others show it") {
  const Made made = make(2, 0.3, 0, 5);
  int absent = 0;
  for (const StripeEvidence& stripe : toward_begin(made, 0.15)) {
    if (!stripe.absent) continue;
    ++absent;
    CHECK(stripe.absent->away > 2);
    CHECK(stripe.absent->away < 5);
    // On the stripe's line: it crosses the seam at one of its places.
    const double crossing = -(stripe.absent->out - 0.3 * stripe.absent->away);
    CHECK(std::abs(std::remainder(crossing + 20, 3.6)) < 0.3);
  }
  CHECK(absent >= 5);
}

// The same, and points of the table under the plate, seen from above, in a stripe before its begin:
// it crosses the seam at -12.8; from 5 mm away to `reach`.
Made with_table(Made made, double reach) {
  constexpr int kStripe = 2;
  REQUIRE(made.cloud.stripes[kStripe].count == 0);
  ScanCloud cloud;
  for (std::size_t k = 0; k < made.cloud.stripes.size(); ++k) {
    const ScanStripe& seen = made.cloud.stripes[k];
    for (int i = seen.first; i < seen.first + seen.count; ++i) {
      cloud.points.push_back(made.cloud.points[i]);
      cloud.origins.push_back(made.cloud.origins[i]);
    }
    if (k == kStripe)
      for (double y = 5; y < reach; y += 0.5) {
        cloud.points.emplace_back(-12.8, y, -10);
        cloud.origins.push_back({kStripe, 0, y == 5 || y + 0.5 >= reach, 0, 0.1f});
      }
    end_stripe(cloud, ScanStripe::Seen::kSeen, seen.camera_centre, seen.tool_position);
  }
  const int added = cloud.size() - made.cloud.size();
  for (int& i : made.plate.points) i += added;  // all of them lie in later stripes
  made.cloud = cloud;
  return made;
}

TEST_CASE("a stripe that does not show the plate at the seam says so, and what it sees behind it") {
  int past = 0;
  for (const StripeEvidence& one : toward_begin(with_table(make(2, 0.3, 0, 5), 35), 0.15)) {
    if (one.off.empty()) continue;
    ++past;
    CHECK(one.absent);
    // Where the line of sight from 200 mm up meets the plane: nearer to the eye's foot.
    CHECK(-one.off[0][0].out < -11.5);
    CHECK(-one.off[0][0].out > -13.5);
  }
  CHECK(past == 1);
}

TEST_CASE("two points behind a plate tell nothing") {
  for (const StripeEvidence& one : toward_begin(with_table(make(2, 0.3, 0, 5), 6), 0.15))
    CHECK(one.off.empty());
}

TEST_CASE("a stripe whose ends lie at one place shows what lies behind the plate all the same") {
  Made made = make(2, 0.3, 0, 5);
  // Out over the table, and back to within a hundredth of a millimetre of where it began.
  ScanCloud cloud;
  for (double way = 0; way <= 60; way += 0.5) {
    cloud.points.emplace_back(-12.8, 5 + std::min(way, 60.01 - way), -10);
    cloud.origins.push_back({0, way <= 30 ? 0 : 1, false, 0, 0.1f});
  }
  end_stripe(cloud, ScanStripe::Seen::kSeen, {-12.8, 100, 200}, {-12.8, 0, 0});
  const int added = cloud.size();
  for (const ScanStripe& seen : made.cloud.stripes) {
    for (int i = seen.first; i < seen.first + seen.count; ++i) {
      cloud.points.push_back(made.cloud.points[i]);
      cloud.origins.push_back(made.cloud.origins[i]);
      ++cloud.origins.back().stripe;
    }
    end_stripe(cloud, ScanStripe::Seen::kSeen, seen.camera_centre, seen.tool_position);
  }
  for (int& i : made.plate.points) i += added;
  made.cloud = cloud;
  int past = 0;
  for (const StripeEvidence& stripe : toward_begin(made, 0.15)) past += !stripe.off.empty();
  CHECK(past == 1);
}

TEST_CASE("where stripes leave a plate over its side is no end of it") {
  // Of three stripes in five something as high goes on beyond the plate's side, 40 mm away.
  const Made made = make(2, 0.3, 0, 5);
  Made beside = made;
  beside.cloud = {};
  beside.plate.points.clear();
  for (std::size_t k = 0; k < made.cloud.stripes.size(); ++k) {
    const ScanStripe& seen = made.cloud.stripes[k];
    const auto add = [&](const Eigen::Vector3d& point, const PointOrigin& origin) {
      beside.plate.points.push_back(beside.cloud.size());
      beside.cloud.points.push_back(point);
      beside.cloud.origins.push_back(origin);
    };
    for (int i = seen.first; i < seen.first + seen.count; ++i)
      add(made.cloud.points[i], made.cloud.origins[i]);
    if (seen.count > 0 && k % 5 < 3)
      for (double y = 45; y < 60; y += 1.5)
        add({seen.tool_position.x() - 0.3 * y, y, 0},
            {static_cast<int>(k), 1, y == 45 || y + 1.5 >= 60, 0, 0.1f});
    end_stripe(beside.cloud, ScanStripe::Seen::kSeen, seen.camera_centre, seen.tool_position);
  }
  for (const StripeEvidence& stripe : toward_begin(beside, 0.15))
    for (const EdgeCrossing& edge : stripe.edges) CHECK(std::abs(edge.away - 40) > 1.5);
}

TEST_CASE("dark stripes beside what may hide the plate may be hidden, too") {
  const Made made = make(30, 0.3, 0, 5);
  Made hidden = made;
  hidden.cloud = {};
  // A block of 8 mm stands before both plates where the plate begins.
  int added = 0;
  for (std::size_t k = 0; k < made.cloud.stripes.size(); ++k) {
    const ScanStripe& seen = made.cloud.stripes[k];
    for (int i = seen.first; i < seen.first + seen.count; ++i) {
      hidden.cloud.points.push_back(made.cloud.points[i]);
      hidden.cloud.origins.push_back(made.cloud.origins[i]);
    }
    if (seen.count == 0 && std::abs(seen.tool_position.x() - 26) < 4)
      for (double y = 4; y < 12; y += 0.5, ++added) {
        hidden.cloud.points.emplace_back(seen.tool_position.x(), y, 8);
        hidden.cloud.origins.push_back({static_cast<int>(k), 0, y == 4 || y == 11.5, 0, 0.1f});
      }
    end_stripe(hidden.cloud, ScanStripe::Seen::kSeen, seen.camera_centre, seen.tool_position);
  }
  for (int& i : hidden.plate.points) i += added;  // all of them lie in later stripes
  int dark = 0;
  for (const StripeEvidence& stripe : toward_begin(hidden, 0.15))
    if (stripe.absent && stripe.absent->out > -30) {
      CHECK(stripe.covered);
      ++dark;
    }
  CHECK(dark > 8);
  for (const StripeEvidence& stripe : toward_begin(made, 0.15)) CHECK_FALSE(stripe.covered);
}

TEST_CASE("in a cloud without stripes the stations alone tell") {
  Made made = make(2, 0.3, 0, 5);
  made.cloud = unorganised_cloud(made.cloud.points);
  for (const auto& side : evidence_of(made, 0.5))
    for (const StripeEvidence& stripe : side) {
      CHECK(stripe.edges.empty());
      CHECK(stripe.off.empty());
      CHECK(stripe.on.empty() == stripe.absent.has_value());
    }
}

// Stripes off an upright onto a plate that a hole takes from 3.3 mm off the seam on: of the strip
// that is left one centre was kept.
Made with_strips(bool in_one_segment) {
  Made made;
  made.plate.plane = {Eigen::Vector3d::UnitZ(), 0};
  made.other.plane = {Eigen::Vector3d::UnitY(), 0};
  for (int k = 0; k < 20; ++k) {
    const double x = 3.6 * k;
    const auto add = [&](double y, double z, JointPlate& plate, int segment) {
      plate.points.push_back(made.cloud.size());
      made.cloud.points.emplace_back(x, y, z);
      made.cloud.origins.push_back({k, segment, false, 0, 0.1f});
    };
    for (const double z : {9.0, 6.0, 3.0, 0.2}) add(0.02, z, made.other, 0);
    add(3, 0.02, made.plate, in_one_segment ? 0 : 1);
    for (double y = 6; k < 15 && y < 36; y += 3) add(y, 0, made.plate, in_one_segment ? 0 : 1);
    end_stripe(made.cloud, ScanStripe::Seen::kSeen, {x, 100, 200}, {x, 0, 0});
  }
  return made;
}

TEST_CASE("a lone point on the plate shows it where the stripe comes off the other plate") {
  for (const bool joined : {true, false}) {
    int strips = 0;
    const auto evidence = evidence_of(with_strips(joined), 0);
    for (const StripeEvidence& stripe : evidence[1]) {
      if (stripe.on.size() == 1 && stripe.on[0][0].away == stripe.on[0][1].away) {
        ++strips;
        CHECK(stripe.on[0][0].away == Approx(3));
        CHECK_FALSE(stripe.absent);
      }
    }
    CHECK(strips == (joined ? 5 : 0));
  }
}
