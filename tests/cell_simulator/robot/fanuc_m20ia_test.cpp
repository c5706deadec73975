#include "services/cell_simulator/robot/fanuc_m20ia.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "common/geometry.hpp"
#include "services/cell_simulator/base/random_stream.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

Joints radians(std::array<double, 6> degrees) {
  for (double& angle : degrees) angle *= kDegree;
  return degrees;
}

// The same arm written out as a product of turns and shifts.
RigidTransform written_out(const Joints& q) {
  using Eigen::AngleAxisd, Eigen::Translation3d, Eigen::Vector3d;
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  RigidTransform t = RigidTransform::Identity();
  t = t * AngleAxisd(q[0], z) * Translation3d(150, 0, 0) * AngleAxisd(q[1], y) *
      Translation3d(0, 0, 790) * AngleAxisd(-q[2], y) * Translation3d(0, 0, 250) *
      AngleAxisd(-q[3], x) * Translation3d(835, 0, 0) * AngleAxisd(-q[4], y) *
      Translation3d(100, 0, 0) * AngleAxisd(-q[5], x);
  return t * AngleAxisd(-std::numbers::pi / 2, y) * AngleAxisd(std::numbers::pi, x);
}

double turn_between(const RigidTransform& a, const RigidTransform& b) {
  return (a.linear() - b.linear()).norm();
}

}  // namespace

TEST_CASE("the M-20iA's pose matches the published vectors") {
  struct Vector {
    std::array<double, 6> degrees;
    double j3_fanuc;
    XyzWpr tool0;
  };
  const std::vector<Vector> vectors = {
      {{0, 0, 0, 0, -90, 0}, 0, {985, 0, 940, 180, 0, 0}},
      {{0, 0, -90, 0, 0, 0}, -90, {400, 0, -145, 180, 0, 0}},
      {{30, 20, -10, 15, -60, 40}, -30, {1110.888, 615.490, 443.919, 170.548, 8.939, 76.792}},
      {{-45, 35, 20, -100, 55, 170}, -15, {1022.073, -1136.158, 643.913, 106.632, -2.931, -13.209}},
      {{10, -40, -60, 30, 45, -120}, -20, {584.486, 138.961, 587.871, -70.513, 0.100, -57.938}},
  };
  const FanucM20ia arm;
  for (const Vector& vector : vectors) {
    const Joints joints = radians(vector.degrees);
    const XyzWpr pose = to_xyzwpr(arm.tool_pose(joints));
    CHECK(pose.x == Approx(vector.tool0.x).margin(0.001));
    CHECK(pose.y == Approx(vector.tool0.y).margin(0.001));
    CHECK(pose.z == Approx(vector.tool0.z).margin(0.001));
    CHECK(std::abs(std::remainder(pose.w - vector.tool0.w, 360)) < 0.001);
    CHECK(pose.p == Approx(vector.tool0.p).margin(0.001));
    CHECK(std::abs(std::remainder(pose.r - vector.tool0.r, 360)) < 0.001);
    CHECK(fanuc_count(joints)[2] == Approx(vector.j3_fanuc * kDegree).margin(1e-12));
    for (const std::size_t other : {0u, 1u, 3u, 4u, 5u})
      CHECK(fanuc_count(joints)[other] == joints[other]);
  }

  const RigidTransform zero = arm.tool_pose({});
  CHECK(zero.translation().isApprox(Eigen::Vector3d(1085, 0, 1040), 1e-9));
  CHECK((zero.linear().col(0) - Eigen::Vector3d(0, 0, 1)).norm() < 1e-12);
  CHECK((zero.linear().col(1) - Eigen::Vector3d(0, -1, 0)).norm() < 1e-12);
  CHECK((zero.linear().col(2) - Eigen::Vector3d(1, 0, 0)).norm() < 1e-12);
  CHECK(to_xyzwpr(zero).p == Approx(-90));
}

TEST_CASE("joints lead to the pose they came from, tool offset included") {
  const RigidTransform tool = from_xyzwpr({31.5, -4.2, 297.8, 1.3, 28.4, -2.1});
  FanucM20ia arm(tool);
  RandomStream random(7);
  for (int i = 0; i < 200; ++i) {
    const Joints truth =
        radians({random.uniform(-150, 150), random.uniform(-60, 90), random.uniform(-90, 60),
                 random.uniform(-150, 150), -random.uniform(15, 110), random.uniform(-150, 150)});
    const RigidTransform pose = written_out(truth) * tool;
    CHECK((arm.tool_pose(truth).translation() - pose.translation()).norm() < 1e-9);
    CHECK(turn_between(arm.tool_pose(truth), pose) < 1e-12);

    Joints near = truth;
    for (double& angle : near) angle += random.uniform(-0.03, 0.03);
    const auto found = arm.joints(pose, near);
    REQUIRE(found);
    for (std::size_t joint = 0; joint < 6; ++joint)
      CHECK((*found)[joint] == Approx(truth[joint]).margin(1e-5));
  }
}

TEST_CASE("what the arm cannot reach has no joints") {
  FanucM20ia arm;
  CHECK_FALSE(arm.joints(from_xyzwpr({3000, 0, 500, 180, 0, 0})));
  CHECK(arm.joints(from_xyzwpr({985, 0, 300, 180, 0, 0})));
  // Straight behind: J1 would have to turn by 180 deg, it turns by 170.
  CHECK_FALSE(arm.joints(from_xyzwpr({-985, 0, 940, 180, 0, 0}), radians({175, 0, 0, 0, -90, 0})));
}

TEST_CASE("W, P and R are turns about the fixed axes x, y, z") {
  const RigidTransform t = from_xyzwpr({1, 2, 3, 20, -35, 50});
  // Each axis turned in its own basis: first x, then y, then z.
  const auto about = [](int axis, double degrees) {
    const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
    Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    m(a, a) = m(b, b) = c;
    m(a, b) = -s;
    m(b, a) = s;
    return m;
  };
  CHECK((t.linear() - about(2, 50) * about(1, -35) * about(0, 20)).norm() < 1e-12);
  const XyzWpr back = to_xyzwpr(t);
  CHECK(back.w == Approx(20));
  CHECK(back.p == Approx(-35));
  CHECK(back.r == Approx(50));
  for (const double p : {90.0, -90.0}) {
    const RigidTransform singular = from_xyzwpr({0, 0, 0, 25, p, -40});
    CHECK((from_xyzwpr(to_xyzwpr(singular)).linear() - singular.linear()).norm() < 1e-9);
  }
}
