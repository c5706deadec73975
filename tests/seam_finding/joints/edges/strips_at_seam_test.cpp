#include "services/seam_finding/joints/edges/strips_at_seam.hpp"

#include <catch2/catch.hpp>

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

// A stripe from an upright in y = 0 onto a base in z = 0 that reaches to `strip` only, and what it
// shows next, in a hole; every fifteenth centre.
struct Scene {
  ScanCloud cloud;
  JointPlate base, upright;

  void add(double y, double z, int segment = 0) {
    cloud.points.emplace_back(0, y, z);
    PointOrigin origin;
    origin.stripe = 0, origin.segment = segment;
    cloud.origins.push_back(origin);
  }
};

Scene upright_alone() {
  Scene scene;
  scene.base.plane = {Eigen::Vector3d::UnitZ(), 0};
  scene.upright.plane = {Eigen::Vector3d::UnitY(), 0};
  for (const double z : {8.7, 5.8, 2.9, 0.2}) {
    scene.upright.points.push_back(scene.cloud.size());
    scene.add(0.02, z);
  }
  return scene;
}

std::vector<int> strips_of(Scene scene) {
  end_stripe(scene.cloud, ScanStripe::Seen::kSeen);
  return strips_at_seam(scene.cloud, scene.base, scene.upright, 0.3);
}

}  // namespace

TEST_CASE(
    "a strip of plate between the seam and a hole is seen where a stripe comes off the other") {
  Scene scene = upright_alone();
  scene.add(2.8, 0.05);  // 4: the strip
  scene.add(3.3, -0.1);  // 5
  scene.add(3.6, -0.8);  // 6: over the hole's edge
  scene.add(12, 0.05);   // 7: beyond it, parted from the seam
  CHECK(strips_of(scene) == std::vector<int>{4, 5});
}

TEST_CASE("no strip is what lies beside the plate, under the other, or in another segment") {
  Scene deep = upright_alone();
  deep.add(2.8, -5);
  CHECK(strips_of(deep).empty());
  Scene under = upright_alone();
  under.add(-1.5, 0);
  CHECK(strips_of(under).empty());
  Scene apart = upright_alone();
  apart.add(2.8, 0, 1);
  CHECK(strips_of(apart).empty());
}
