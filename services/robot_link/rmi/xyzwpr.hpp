// A frame as FANUC writes it: X Y Z in mm; W, P, R in degrees about the fixed axes x, y, z in this
// order, R = Rz(R) Ry(P) Rx(W) (B-84184EN, and the M-20iA's test vectors).
#pragma once

#include <array>

#include "common/geometry.hpp"

namespace arcstart::robot_link {

using XyzWpr = std::array<double, 6>;

inline RigidTransform from_xyzwpr(const XyzWpr& v) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  RigidTransform transform = RigidTransform::Identity();
  transform.translation() << v[0], v[1], v[2];
  transform.linear() = (AngleAxisd(v[5] * kDegree, Vector3d::UnitZ()) *
                        AngleAxisd(v[4] * kDegree, Vector3d::UnitY()) *
                        AngleAxisd(v[3] * kDegree, Vector3d::UnitX()))
                           .toRotationMatrix();
  return transform;
}

// Where P is +-90 deg, W is 0.
inline XyzWpr to_xyzwpr(const RigidTransform& transform) {
  const Eigen::Matrix3d m = transform.linear();
  const Eigen::Vector3d t = transform.translation();
  const double level = std::hypot(m(0, 0), m(1, 0));  // cosine of P
  const bool singular = level < 1e-9;
  return {t.x(),
          t.y(),
          t.z(),
          singular ? 0 : std::atan2(m(2, 1), m(2, 2)) / kDegree,
          std::atan2(-m(2, 0), level) / kDegree,
          (singular ? std::atan2(-m(0, 1), m(1, 1)) : std::atan2(m(1, 0), m(0, 0))) / kDegree};
}

}  // namespace arcstart::robot_link
