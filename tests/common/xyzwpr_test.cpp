#include "common/xyzwpr.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace arcstart;

namespace {

// Rz(R) Ry(P) Rx(W) multiplied out by hand.
Eigen::Matrix3d product(double w_deg, double p_deg, double r_deg) {
  const double w = w_deg * M_PI / 180, p = p_deg * M_PI / 180, r = r_deg * M_PI / 180;
  const double cw = std::cos(w), sw = std::sin(w), cp = std::cos(p), sp = std::sin(p);
  const double cr = std::cos(r), sr = std::sin(r);
  Eigen::Matrix3d m;
  m << cr * cp, cr * sp * sw - sr * cw, cr * sp * cw + sr * sw,  //
      sr * cp, sr * sp * sw + cr * cw, sr * sp * cw - cr * sw,   //
      -sp, cp * sw, cp * cw;
  return m;
}

void check_same(const Eigen::Quaterniond& rotation, const Eigen::Matrix3d& expected) {
  CHECK(rotation.norm() == Approx(1).margin(1e-15));
  CHECK((rotation.toRotationMatrix() - expected).cwiseAbs().maxCoeff() < 1e-14);
}

}  // namespace

TEST_CASE("WPR: the tool's axes in poses that anybody can check") {
  // Tool pointing down: W = 180.
  check_same(rotation_from_wpr(180, 0, 0), Eigen::Vector3d(1, -1, -1).asDiagonal());
  // The arm stretched out: P = -90, tool axes (0,0,1), (0,-1,0), (1,0,0) with W = 180.
  Eigen::Matrix3d stretched;
  stretched << 0, 0, 1, 0, -1, 0, 1, 0, 0;
  check_same(rotation_from_wpr(180, -90, 0), stretched);
  // R turns X to Y, W turns Y to Z, P turns Z to X: each axis by itself.
  CHECK(
      (rotation_from_wpr(0, 0, 90) * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY()));
  CHECK(
      (rotation_from_wpr(90, 0, 0) * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitZ()));
  CHECK(
      (rotation_from_wpr(0, 90, 0) * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
}

TEST_CASE("WPR: the same as the product of three turns, also where the angles are singular") {
  std::mt19937 random(2);
  std::uniform_real_distribution<> angle(-180, 180);
  for (int i = 0; i < 500; ++i) {
    const double p = i % 5 == 0 ? 90 : i % 5 == 1 ? -90 : angle(random);
    const double w = angle(random), r = angle(random);
    check_same(rotation_from_wpr(w, p, r), product(w, p, r));
  }
}

TEST_CASE("WPR: poses of the M-20iA with known angles") {
  // Joint angles and W, P, R from two programs of kinematics; here the tool's Z axis follows from
  // the product of the joints' turns: Rz(q1) Ry(q2) Ry(-q3) Rx(-q4) Ry(-q5) Rx(-q6) x.
  struct Pose {
    double q[6], w, p, r;
  };
  const Pose poses[] = {{{30, 20, -10, 15, -60, 40}, 170.548, 8.939, 76.792},
                        {{-45, 35, 20, -100, 55, 170}, 106.632, -2.931, -13.209},
                        {{10, -40, -60, 30, 45, -120}, -70.513, 0.100, -57.938}};
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const auto turn = [](double degrees, const Vector3d& axis) {
    return AngleAxisd(degrees * M_PI / 180, axis).toRotationMatrix();
  };
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  for (const Pose& pose : poses) {
    const auto& q = pose.q;
    const Eigen::Matrix3d flange = turn(q[0], z) * turn(q[1], y) * turn(q[2], -y) * turn(q[3], -x) *
                                   turn(q[4], -y) * turn(q[5], -x);
    const Eigen::Matrix3d tool = flange * turn(-90, y) * turn(180, x);
    const Eigen::Matrix3d from_angles =
        rotation_from_wpr(pose.w, pose.p, pose.r).toRotationMatrix();
    CHECK((tool - from_angles).cwiseAbs().maxCoeff() < 2e-5);
  }
}

TEST_CASE("WPR: there and back is the same frame, also where the angles are singular") {
  std::mt19937 random(3);
  std::uniform_real_distribution<> angle(-180, 180), place(-2000, 2000);
  for (int i = 0; i < 500; ++i) {
    const double p = i % 5 == 0 ? 90 : i % 5 == 1 ? -90 : angle(random);
    RigidTransform frame = RigidTransform::Identity();
    frame.linear() = product(angle(random), p, angle(random));
    frame.translation() << place(random), place(random), place(random);
    const XyzWpr numbers = to_xyzwpr(frame);
    CHECK(std::abs(numbers[4]) <= 90);
    CHECK((product(numbers[3], numbers[4], numbers[5]) - frame.linear()).cwiseAbs().maxCoeff() <
          1e-7);
    CHECK(from_xyzwpr(numbers).isApprox(frame, 1e-7));
  }
}
