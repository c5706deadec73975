#include "services/seam_finding/referee/corner/corner_radius.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

constexpr double kLength = 100, kPitch = 4, kTolerance = 0.3;

using Section = std::vector<Eigen::Vector3d>;  // at x = 0, of the plates z = 0 and y = 0

// The plates end at the corner: the upper one from y = 0 on, the hanging one from z = 0 down, but
// for what is nearer to it than `from`.
Section plates(double from) {
  Section section;
  for (double off = from; off < 40; off += 0.5) {
    section.emplace_back(0, off, 0);
    section.emplace_back(0, 0, -off);
  }
  return section;
}

Section round_corner(double radius) {
  Section section = plates(radius);
  for (double angle = 0.05; angle < M_PI / 2; angle += 0.1)
    section.emplace_back(0, radius * (1 - std::sin(angle)), -radius * (1 - std::cos(angle)));
  return section;
}

// Down into a gap of this width between the upper plate and the hanging one.
Section gap(double width, double depth) {
  Section section = plates(0);
  section.emplace_back(0, width, -depth);
  return section;
}

// In a root all of it lies before the planes, on the other side of z = 0.
std::optional<double> radius_of(const std::function<Section(int stripe)>& section,
                                const std::string& joint = "outside_corner") {
  const bool root = joint != "outside_corner";
  ScanCloud cloud;
  for (int k = 0; k * kPitch <= kLength; ++k) {
    const int first = cloud.size();
    for (Eigen::Vector3d point : section(k)) {
      point.x() = k * kPitch;
      if (root) point.z() = -point.z();
      cloud.points.push_back(point);
      PointOrigin origin;
      origin.stripe = k;
      cloud.origins.push_back(origin);
    }
    ScanStripe stripe;
    stripe.first = first, stripe.count = cloud.size() - first;
    cloud.stripes.push_back(stripe);
  }
  SeamResult seam;
  seam.joint_type = joint;
  seam.end = kLength * Eigen::Vector3d::UnitX(), seam.direction = Eigen::Vector3d::UnitX();
  seam.faces[0].plane = {Eigen::Vector3d::UnitZ(), 0};
  seam.faces[1].plane = {(root ? 1 : -1) * Eigen::Vector3d::UnitY(), 0};
  std::vector<int> points(cloud.points.size());
  std::iota(points.begin(), points.end(), 0);
  return corner_radius(cloud, points, seam, kTolerance);
}

}  // namespace

TEST_CASE("an outside corner on one arc all along is round, with the arc's radius") {
  for (const double radius : {3.0, 6.0, 10.0}) {
    const auto found = radius_of([&](int) { return round_corner(radius); });
    INFO(radius << " mm");
    REQUIRE(found);
    CHECK(*found == Approx(radius).epsilon(0.02));
  }
}

TEST_CASE("a corner of two edges is not round: sharp, with a gap, or with tacks on it") {
  CHECK_FALSE(radius_of([](int) { return plates(0); }));
  CHECK_FALSE(radius_of([](int k) { return gap(1.5, 2.0 + k % 5); }));
  // Nothing seen of it.
  CHECK_FALSE(radius_of([](int) { return plates(3); }));
  CHECK_FALSE(radius_of([](int k) { return k % 4 == 0 ? round_corner(4) : plates(0); }));
  // Each stripe another arc.
  CHECK_FALSE(radius_of([](int k) { return round_corner(3.0 + k % 5 * 2); }));
}

TEST_CASE("a root on one arc all along is one piece's, rolled, or filled already") {
  for (const std::string joint : {"tee", "corner"})
    for (const double radius : {3.0, 7.0, 12.0}) {
      const auto found = radius_of([&](int) { return round_corner(radius); }, joint);
      INFO(joint << " " << radius << " mm");
      REQUIRE(found);
      CHECK(*found == Approx(radius).epsilon(0.02));
    }
}

TEST_CASE("a root is open where it is sharp, rounded by the image alone, or tacked") {
  CHECK_FALSE(radius_of([](int) { return plates(0); }, "tee"));
  CHECK_FALSE(radius_of([](int) { return round_corner(1.8); }, "tee"));
  CHECK_FALSE(radius_of([](int k) { return k % 2 == 0 ? round_corner(5) : plates(0); }, "tee"));
  // A cable lies along it, nearer and farther.
  CHECK_FALSE(radius_of([](int k) { return round_corner(3.0 + k % 5 * 2); }, "corner"));
}
