#include "services/seam_finding/ends/plate_evidence.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <random>

#include "services/seam_finding/coverage/stations.hpp"
#include "services/seam_finding/ends/constants.hpp"
#include "tests/seam_finding/support/likelihood_moments.hpp"
#include "tests/seam_finding/support/scales.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

// A plate in z = 0 from x = begin to 100 and y = 0 to 40, its seam along the x axis; stripes every
// 3.6 mm cross it at a slant, thinned out to every fifteenth of their centres a tenth of a
// millimetre apart, and end a pixel's fraction before its edges. next: the height over the plate of
// what a stripe shows next; 0 for nothing.
struct Made {
  ScanCloud cloud;
  JointPlate plate, other;
  Line line{{0, 0, 0}, {1, 0, 0}};
};

// turn: of the edge at its begin, mm farther in for each mm away. cut: by how much a stripe that
// turns over that edge, onto the plate's cut, goes on along the seam for each mm down; mm.
Made make(double begin, double slant, double next, unsigned seed, double turn = 0,
          std::optional<double> cut = {}) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0, 0.02);
  std::uniform_real_distribution<double> phase(0, 0.1);
  Made made;
  made.plate.plane = {Eigen::Vector3d::UnitZ(), 0};
  made.other.plane = {Eigen::Vector3d::UnitY(), 0};
  for (double x = -20; x < 120; x += 3.6) {
    const int stripe = static_cast<int>(made.cloud.stripes.size());
    std::vector<Eigen::Vector3d> centres;  // outward from the seam
    for (double y = phase(engine); y < 40; y += 0.1)
      if (const double along = x - slant * y; along > begin + turn * y && along < 100)
        centres.emplace_back(along + noise(engine), y, noise(engine));
    const auto add = [&](const Eigen::Vector3d& point, int segment, bool end) {
      made.cloud.points.push_back(point);
      made.cloud.origins.push_back({stripe, segment, end, 0, 0.1f * std::hypot(1.0f, 0.3f)});
    };
    const bool turns = cut && !centres.empty() && centres.back().x() < begin + 0.5;
    for (std::size_t i = 0; i < centres.size(); ++i)
      if (i % 15 == 0 || i + 1 == centres.size()) {
        made.plate.points.push_back(made.cloud.size());
        add(centres[i], 0, i == 0 || (i + 1 == centres.size() && !turns));
      }
    if (turns)
      for (double depth = 0.7; depth < 3; depth += 0.7) {
        const double y = centres.back().y();
        add({begin - *cut * depth + noise(engine), y, -depth + noise(engine)}, 0, depth > 2.5);
      }
    if (next != 0 && !centres.empty()) add(centres.back() + Eigen::Vector3d(-1, 1, next), 1, true);
    end_stripe(made.cloud, ScanStripe::Seen::kSeen, {x, 100, 200}, {x, 0, 0});
  }
  return made;
}

const Scales kScales = scales_of_test(3.6, 0.5, 0.02);

std::array<std::vector<StripeEvidence>, 2> evidence_of(const Made& made, double shortening_px) {
  SeamFindingSettings settings;
  settings.edge_shortening_px = shortening_px;
  const PlateStripes stripes =
      plate_stripes(made.cloud, made.plate, made.other, made.line, kScales);
  const Stations stations =
      stations_along(made.cloud, {made.plate, made.other}, made.line, kScales);
  return plate_evidence(made.cloud, stripes, stations, 0, kScales, settings);
}

std::vector<StripeEvidence> toward_begin(const Made& made, double shortening_px) {
  return evidence_of(made, shortening_px)[0];
}

struct Edge {
  double along = 0, deviation = 0;
  FootLikelihood likelihood;
};

Edge edge_of(const Made& made, SeamSide side, double about, double shortening_px) {
  const double outward = static_cast<double>(side);
  const PlaceGrid grid{outward * about - 10, 0.05, 400};
  Edge edge;
  edge.likelihood = foot_likelihood(evidence_of(made, shortening_px)[side == SeamSide::kEnd], grid,
                                    {0, SeamFindingSettings{}.edge_slope()});
  const PlaceMoments found = moments_of(edge.likelihood, grid);
  edge.along = outward * found.mean;
  edge.deviation = std::hypot(found.deviation, edge.likelihood.deviation);
  return edge;
}

}  // namespace

TEST_CASE("the edge of a plate is found to a fraction of the stripes' distance") {
  for (const double slant : {0.3, -0.3, 0.2}) {
    int within = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const double begin = 0.17 * seed;
      const Made made = make(begin, slant, -10, seed);
      INFO("slant " << slant << ", seed " << seed);
      const Edge edge = edge_of(made, SeamSide::kBegin, begin, 0.15);
      CHECK(edge.along == Approx(begin).margin(0.2));
      CHECK_FALSE(edge.likelihood.occluded);
      within += std::abs(edge.along - begin) <= 2 * edge.deviation;
      CHECK(edge_of(made, SeamSide::kEnd, 100, 0.15).along == Approx(100).margin(0.15));
    }
    CHECK(within >= 18);
  }
}

TEST_CASE("stripes square to the seam cross no edge; what lies before a plate hides its edge") {
  for (const auto& side : evidence_of(make(0, 0, 0, 1), 0.5))
    for (const StripeEvidence& stripe : side)
      for (const EdgeCrossing& edge : stripe.edges) CHECK(leaving(edge, 0) < kEnds.least_slant);
  int occluded = 0;
  for (const StripeEvidence& stripe : toward_begin(make(2, 0.3, 9, 3), 0.5))
    for (const EdgeCrossing& edge : stripe.edges) {
      if (leaving(edge, 0) < 0) continue;  // over the plate's other end
      CHECK(edge.occluded);
      CHECK(stripe.covered);
      ++occluded;
    }
  CHECK(occluded >= 3);
}

TEST_CASE("a stripe whose light ends too early draws no edge to it") {
  Made made = make(2, 0.4, -10, 6);
  const double as_made = edge_of(made, SeamSide::kBegin, 2, 0.03).along;
  for (const int i : made.plate.points)
    if (made.cloud.origins[i].segment_end && std::abs(made.cloud.points[i].x() - 2) < 0.1) {
      made.cloud.points[i] += Eigen::Vector3d(0.6, -0.6 / 0.4, 0);
      break;
    }
  CHECK(edge_of(made, SeamSide::kBegin, 2, 0.03).along == Approx(as_made).margin(0.05));
}

TEST_CASE("a place where a stripe crosses an edge flatly counts for little") {
  const auto deviation = [](double slant) {
    for (const StripeEvidence& stripe : toward_begin(make(2, slant, 0, 7), 0.03))
      if (!stripe.edges.empty()) return std::sqrt(variance_of(stripe.edges[0], 0, 0));
    return 0.0;
  };
  REQUIRE(deviation(0.4) > 0);
  CHECK(deviation(0.1) > 2 * deviation(0.4));
}

TEST_CASE("an edge cut at a slant is found by what falls over it") {
  for (const double slope : {-0.45, -0.2, 0.1, 0.2}) {
    int within = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const double begin = 1 + 0.13 * seed;
      Made made = make(begin, 0.4, -10, seed);
      for (Eigen::Vector3d& point : made.cloud.points) point.x() += slope * point.y();
      const Edge edge = edge_of(made, SeamSide::kBegin, begin, 0.15);
      INFO("slope " << slope << ", seed " << seed);
      CHECK(edge.along == Approx(begin).margin(0.3));
      within += std::abs(edge.along - begin) <= 2 * edge.deviation;
    }
    CHECK(within >= 17);
  }
}

TEST_CASE("over an edge steeper than itself a stripe comes onto the plate") {
  for (const double turn : {-0.45, -0.55}) {
    int within = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const double begin = 1 + 0.13 * seed;
      const Edge edge = edge_of(make(begin, 0.2, -10, seed, turn), SeamSide::kBegin, begin, 0.15);
      INFO("turn " << turn << ", seed " << seed);
      CHECK(edge.along == Approx(begin).margin(0.6));
      within += std::abs(edge.along - begin) <= 2 * edge.deviation;
    }
    CHECK(within >= 8);
  }
}

TEST_CASE("a stripe that turns over an edge onto a cut tells the edge, square or slanted") {
  for (const double cut : {0.0, 0.3, 0.45}) {
    int within = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const double begin = 1 + 0.13 * seed;
      const Edge edge = edge_of(make(begin, 0.3, 0, seed, 0, cut), SeamSide::kBegin, begin, 0.15);
      INFO("cut " << cut << ", seed " << seed);
      CHECK(edge.along == Approx(begin).margin(0.15));
      within += std::abs(edge.along - begin) <= 2 * edge.deviation;
    }
    CHECK(within >= 8);
  }
}

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
