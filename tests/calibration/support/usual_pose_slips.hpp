// What users' programs and files do to right poses; each by its own arithmetic.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "common/geometry.hpp"

namespace arcstart::test {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

inline Matrix3d about(const Vector3d& axis, double angle) {
  return AngleAxisd(angle, axis).toRotationMatrix();
}
inline Matrix3d about_x(double angle) { return about(Vector3d::UnitX(), angle); }
inline Matrix3d about_y(double angle) { return about(Vector3d::UnitY(), angle); }
inline Matrix3d about_z(double angle) { return about(Vector3d::UnitZ(), angle); }

inline RigidTransform placed(const Matrix3d& rotation, const Vector3d& position) {
  RigidTransform result = RigidTransform::Identity();
  result.linear() = rotation;
  result.translation() = position;
  return result;
}

// W, P, R of FANUC's manual, by the entries of Rz(R) Ry(P) Rx(W); rad.
inline Vector3d wpr(const Matrix3d& m) {
  return {std::atan2(m(2, 1), m(2, 2)), std::asin(-m(2, 0)), std::atan2(m(1, 0), m(0, 0))};
}
inline Matrix3d of_wpr(const Vector3d& a) {
  return about_z(a.z()) * about_y(a.y()) * about_x(a.x());
}

inline Matrix3d of_vector(const Vector3d& v) { return about(v.normalized(), v.norm()); }
inline Vector3d vector_of(const Matrix3d& m) {
  const AngleAxisd turn(m);
  return turn.angle() * turn.axis();
}

using Change = std::function<void(RigidTransform&)>;

inline Change rotation(const std::function<Matrix3d(const Matrix3d&)>& change) {
  return [change](RigidTransform& pose) { pose.linear() = change(pose.linear()).eval(); };
}
inline Change positions(double factor) {
  return [factor](RigidTransform& pose) { pose.translation() *= factor; };
}

struct PoseSlip {
  const char* named;
  Change change;
};

// What a user's program or file does to a right pose, and the words that must come.
inline std::vector<PoseSlip> usual_pose_slips() {
  const auto quaternion = [](const Matrix3d& m) { return Eigen::Quaterniond(m); };
  return {{"base lies in the tool", [](RigidTransform& pose) { pose = pose.inverse(); }},
          {"orientations that are inverted",
           rotation([](const Matrix3d& m) { return Matrix3d(m.transpose()); })},
          {"read as x, y, z, w", rotation([&](const Matrix3d& m) {
             const auto q = quaternion(m);
             return Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()).toRotationMatrix();
           })},
          {"scalar stood first", rotation([&](const Matrix3d& m) {
             const auto q = quaternion(m);
             return Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
           })},
          {"turned in the order Rz Ry Rx, where Rx Ry Rz", rotation([](const Matrix3d& m) {
             const Vector3d a = wpr(m);
             return Matrix3d(about_x(a.x()) * about_y(a.y()) * about_z(a.z()));
           })},
          {"first and third angle exchanged (KUKA", rotation([](const Matrix3d& m) {
             const Vector3d a = wpr(m);
             return of_wpr({a.z(), a.y(), a.x()});
           })},
          {"exchanged and turned in the order Rz Ry Rx", rotation([](const Matrix3d& m) {
             const Vector3d a = wpr(m);
             return Matrix3d(about_x(a.z()) * about_y(a.y()) * about_z(a.x()));
           })},
          {"degrees, which were read as radians",
           rotation([](const Matrix3d& m) { return of_wpr(wpr(m) * 180 / EIGEN_PI); })},
          {"radians, which were read as degrees",
           rotation([](const Matrix3d& m) { return of_wpr(wpr(m) * EIGEN_PI / 180); })},
          {"W, P, R, which were read as a rotation vector",
           rotation([](const Matrix3d& m) { return of_vector(wpr(m)); })},
          {"rotation vectors, which were read as W, P, R",
           rotation([](const Matrix3d& m) { return of_wpr(vector_of(m) * EIGEN_PI / 180); })},
          {"mirrored",
           [](RigidTransform& pose) {
             const Matrix3d mirror = Vector3d(1, -1, 1).asDiagonal();
             pose = placed(mirror * pose.linear() * mirror, mirror * pose.translation());
           }},
          {"the positions' y with the other sign",
           [](RigidTransform& pose) { pose.translation().y() *= -1; }},
          {"positions in metres", positions(1e-3)},
          {"positions in centimetres", positions(0.1)},
          {"positions in inches", positions(1 / 25.4)}};
}

}  // namespace arcstart::test
