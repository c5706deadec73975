// Poses as a robot's pendant shows them: X Y Z in mm, W P R in degrees about the fixed axes x, y,
// z in this order (FANUC; R = Rz(R) Ry(P) Rx(W)).
#pragma once

#include <Eigen/Geometry>

#include "common/geometry.hpp"

namespace arcstart {

inline Eigen::Quaterniond rotation_from_wpr(double w_deg, double p_deg, double r_deg) {
  return Eigen::AngleAxisd(r_deg * kDegree, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(p_deg * kDegree, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(w_deg * kDegree, Eigen::Vector3d::UnitX());
}

// numbers: six.
inline RigidTransform transform_from_xyzwpr(const double* numbers) {
  return make_transform(Eigen::Vector3d(numbers[0], numbers[1], numbers[2]),
                        rotation_from_wpr(numbers[3], numbers[4], numbers[5]));
}

// P within +-90 deg; at +-90 W is 0.
inline Eigen::Matrix<double, 6, 1> xyzwpr_from_transform(const RigidTransform& transform) {
  const Eigen::Matrix3d m = transform.linear();
  const double level = std::hypot(m(0, 0), m(1, 0));
  const bool upright = level < 1e-9;
  Eigen::Matrix<double, 6, 1> numbers;
  numbers << transform.translation(), upright ? 0.0 : std::atan2(m(2, 1), m(2, 2)) / kDegree,
      std::atan2(-m(2, 0), level) / kDegree,
      (upright ? std::atan2(-m(0, 1), m(1, 1)) : std::atan2(m(1, 0), m(0, 0))) / kDegree;
  return numbers;
}

}  // namespace arcstart
