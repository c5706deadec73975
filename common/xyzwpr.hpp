// A frame as FANUC's pendant and packets have it: X Y Z in mm; W, P, R in degrees about the fixed
// axes x, y, z in this order, R = Rz(R) Ry(P) Rx(W) (B-84184EN, and the M-20iA's test vectors).
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "common/geometry.hpp"

namespace arcstart {

using XyzWpr = std::array<double, 6>;

// A unit quaternion. Holds at P = +-90 deg too, where the angles are singular and must never be
// interpolated.
inline Eigen::Quaterniond rotation_from_wpr(double w_deg, double p_deg, double r_deg) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(r_deg * kDegree, Vector3d::UnitZ()) *
          AngleAxisd(p_deg * kDegree, Vector3d::UnitY()) *
          AngleAxisd(w_deg * kDegree, Vector3d::UnitX()))
      .normalized();
}

inline RigidTransform from_xyzwpr(const XyzWpr& v) {
  return make_transform(Eigen::Vector3d(v[0], v[1], v[2]), rotation_from_wpr(v[3], v[4], v[5]));
}

// P within +-90 deg; there W is 0.
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

}  // namespace arcstart
