#include "services/seam_finding/joints/crossing_joints.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "tests/seam_finding/support/scales.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

constexpr double kSight = 0.75;  // mm toward -y for each mm down

// A wall in y = 0 that begins `begin` over a base in z = 0, mm; the base is seen from `from` on, in
// stripes of which every fifteenth centre is kept.
std::vector<Joint> joints_of(double begin, double from) {
  ScanCloud cloud;
  Face base, wall;
  base.plane = {Eigen::Vector3d::UnitZ(), 0}, wall.plane = {Eigen::Vector3d::UnitY(), 0};
  base.spacing = wall.spacing = 4;
  for (int k = 0; k < 25; ++k) {
    const double x = 4.0 * k;
    const auto add = [&](double y, double z, int segment, Face& face) {
      face.points.push_back(cloud.size());
      cloud.points.emplace_back(x, y, z);
      PointOrigin origin;
      origin.stripe = k, origin.segment = segment;
      cloud.origins.push_back(origin);
    };
    for (double z = begin + 32; z >= begin; z -= 3.2) add(0, z, 0, wall);
    for (double y = from; y < 36; y += 3.2) add(y, 0, 1, base);
    end_stripe(cloud, ScanStripe::Seen::kSeen, {x, kSight * 240, 240}, {x, kSight * 240, 240});
  }
  std::vector<int> all(cloud.points.size());
  std::iota(all.begin(), all.end(), 0);
  return find_crossing_joints(cloud, all, {base, wall}, JointType::kTee, scales_of_test(4, 0.3),
                              SeamFindingSettings{});
}

}  // namespace

TEST_CASE("a hollow section's round edge lets the base be seen under its wall") {
  // A radius of 7 mm: of the arc no more is seen than lies within a tolerance of the wall, and past
  // its outline the base, 4 mm behind the wall's plane.
  const auto joints = joints_of(5.4, -0.98 * 5.4 * kSight);
  REQUIRE(joints.size() == 1);
  CHECK_FALSE(joints[0].flaw);
}

TEST_CASE("a base that is seen through the other plate makes no tee with it") {
  const auto joints = joints_of(0.4, -4);
  REQUIRE(joints.size() == 1);
  CHECK(joints[0].flaw.code == Reason::Code::kNotConcave);
}
