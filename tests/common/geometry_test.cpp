#include "common/geometry.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace arcstart;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

Vector3d random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  const double x = uniform(random), y = uniform(random), z = uniform(random);
  return {x, y, z};
}

// Rotation by Rodrigues' formula, written out: what the library does through quaternions is judged
// by it.
Eigen::Matrix3d rodrigues(const Vector3d& axis, double angle) {
  Eigen::Matrix3d cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return Eigen::Matrix3d::Identity() + std::sin(angle) * cross +
         (1 - std::cos(angle)) * cross * cross;
}

}  // namespace

TEST_CASE("make_transform normalises its quaternion and turns a known point") {
  const double half = 45 * kDegree;
  const RigidTransform transform =
      make_transform({10, 20, 30}, {3 * std::cos(half), 0, 0, 3 * std::sin(half)});
  // 90 degrees about z: x goes to y.
  CHECK((transform * Vector3d{1, 0, 0} - Vector3d{10, 21, 30}).norm() < 1e-12);
  CHECK((transform * Vector3d{0, 1, 0} - Vector3d{9, 20, 30}).norm() < 1e-12);
  CHECK((transform * Vector3d{0, 0, 1} - Vector3d{10, 20, 31}).norm() < 1e-12);
}

TEST_CASE("arrays are mm and w, x, y, z, and come back as they went") {
  const double position[3] = {1, 2, 3};
  const double quaternion[4] = {0.5, -0.5, 0.5, 0.5};
  double position_back[3], quaternion_back[4];
  const RigidTransform transform = transform_from_arrays(position, quaternion);
  CHECK(transform.linear().isApprox(rodrigues(Vector3d{-1, 1, 1}.normalized(), 120 * kDegree)));
  transform_to_arrays(transform, position_back, quaternion_back);
  for (int i = 0; i < 3; ++i) CHECK(position_back[i] == position[i]);
  for (int i = 0; i < 4; ++i) CHECK(quaternion_back[i] == Approx(quaternion[i]).margin(1e-15));

  const double opposite[4] = {-0.5, 0.5, -0.5, -0.5};  // the same rotation
  transform_to_arrays(transform_from_arrays(position, opposite), position_back, quaternion_back);
  for (int i = 0; i < 4; ++i) CHECK(quaternion_back[i] == Approx(quaternion[i]).margin(1e-15));
}

TEST_CASE("interpolation goes straight in position and evenly about one axis in orientation") {
  std::mt19937 random(1);
  for (int n = 0; n < 100; ++n) {
    const Vector3d axis = random_vector(random, 1).normalized();
    const double turn = (n + 0.5) / 100 * 179.9 * kDegree;
    const Eigen::Matrix3d start = rodrigues(random_vector(random, 1).normalized(), n * 0.06);
    RigidTransform a = RigidTransform::Identity(), b = a;
    a.translation() = random_vector(random, 1000);
    b.translation() = random_vector(random, 1000);
    a.linear() = start;
    b.linear() = start * rodrigues(axis, turn);
    for (const double share : {0.0, 1e-9, 0.1, 0.5, 0.75, 1.0}) {
      const RigidTransform between = interpolate(a, b, share);
      const Vector3d position = a.translation() + share * (b.translation() - a.translation());
      CHECK((between.translation() - position).norm() < 1e-9);
      CHECK((between.linear() - start * rodrigues(axis, share * turn)).norm() < 1e-9);
      CHECK((between.linear().transpose() * between.linear() - Eigen::Matrix3d::Identity()).norm() <
            1e-12);
    }
  }
}

TEST_CASE("interpolation takes the shorter arc") {
  // 170 and -170 degrees about z: 20 degrees apart through 180, 340 through 0.
  const RigidTransform a =
      make_transform({0, 0, 0}, Quaterniond(AngleAxisd(170 * kDegree, Vector3d::UnitZ())));
  const RigidTransform b =
      make_transform({0, 0, 0}, Quaterniond(AngleAxisd(-170 * kDegree, Vector3d::UnitZ())));
  CHECK((interpolate(a, b, 0.5).linear() - rodrigues(Vector3d::UnitZ(), 180 * kDegree)).norm() <
        1e-12);
  CHECK((interpolate(a, b, 0.25).linear() - rodrigues(Vector3d::UnitZ(), 175 * kDegree)).norm() <
        1e-12);
}

TEST_CASE("equal poses interpolate to themselves") {
  const RigidTransform a = make_transform({1, 2, 3}, Quaterniond(0.5, 0.5, -0.5, 0.5));
  CHECK(interpolate(a, a, 0.3).isApprox(a, 1e-14));
}

TEST_CASE("a plane keeps its points in another frame") {
  std::mt19937 random(2);
  for (int n = 0; n < 100; ++n) {
    const Plane plane{random_vector(random, 1).normalized(), random_vector(random, 300).x()};
    RigidTransform transform = RigidTransform::Identity();
    transform.linear() = rodrigues(random_vector(random, 1).normalized(), n * 0.06);
    transform.translation() = random_vector(random, 1000);
    const Plane there = transform_plane(transform, plane);
    const Vector3d point = random_vector(random, 500);
    CHECK(there.signed_distance(transform * point) ==
          Approx(plane.signed_distance(point)).margin(1e-9));
    CHECK(there.normal.norm() == Approx(1).epsilon(1e-12));
    CHECK(there.flipped().signed_distance(transform * point) ==
          Approx(-plane.signed_distance(point)).margin(1e-9));
  }
}

TEST_CASE("the line of two planes lies in both, its point nearest to the one given") {
  const Plane floor{{0, 0, 1}, -5}, wall{{1, 0, 0}, -7};  // z = 5, x = 7
  const auto line = intersect(floor, wall, {100, 42, -100});
  REQUIRE(line);
  CHECK((line->point - Vector3d{7, 42, 5}).norm() < 1e-12);
  CHECK(std::abs(line->direction.y()) == Approx(1));
  CHECK(line->along({0, 50, 0}) * line->direction.y() == Approx(8));
  CHECK(line->distance({10, 0, 9}) == Approx(5));

  std::mt19937 random(3);
  for (int n = 0; n < 100; ++n) {
    const Plane a{random_vector(random, 1).normalized(), random_vector(random, 300).x()};
    const Plane b{random_vector(random, 1).normalized(), random_vector(random, 300).x()};
    const Vector3d near = random_vector(random, 300);
    const auto cut = intersect(a, b, near);
    if (angle_between(a.normal, b.normal) < 1 * kDegree ||
        angle_between(a.normal, -b.normal) < 1 * kDegree)
      continue;
    REQUIRE(cut);
    for (const double t : {-500.0, 0.0, 500.0}) {
      CHECK(std::abs(a.signed_distance(cut->at(t))) < 1e-6);
      CHECK(std::abs(b.signed_distance(cut->at(t))) < 1e-6);
    }
    CHECK(std::abs((near - cut->point).dot(cut->direction)) < 1e-6);
    CHECK(cut->direction.norm() == Approx(1));
  }
}

TEST_CASE("planes parallel within 0.1 degrees have no line") {
  const Plane a{{0, 0, 1}, 0};
  CHECK_FALSE(intersect(a, {{0, 0, 1}, -5}, Vector3d::Zero()));
  CHECK_FALSE(intersect(a, {{0, 0, -1}, 5}, Vector3d::Zero()));
  CHECK_FALSE(
      intersect(a, {{std::sin(0.09 * kDegree), 0, std::cos(0.09 * kDegree)}, 0}, Vector3d::Zero()));
  CHECK(
      intersect(a, {{std::sin(0.11 * kDegree), 0, std::cos(0.11 * kDegree)}, 0}, Vector3d::Zero()));
}

TEST_CASE("angles are exact near 0 and 180 degrees") {
  for (const double angle : {0.0, 1e-10, 1e-5, 0.5, std::numbers::pi / 2, 3.0,
                             std::numbers::pi - 1e-10, std::numbers::pi})
    CHECK(angle_between({2, 0, 0}, {3 * std::cos(angle), 3 * std::sin(angle), 0}) ==
          Approx(angle).margin(1e-15));
}
