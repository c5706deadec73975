// FANUC's orientation angles: W about X, P about Y, R about Z, fixed axes, in this order.
#pragma once

#include <Eigen/Geometry>

namespace arcstart::robot_pose {

// Rz(R) Ry(P) Rx(W); degrees in, unit quaternion out. Holds at P = +-90 deg too, where the angles
// are singular and must never be interpolated.
inline Eigen::Quaterniond rotation_from_wpr(double w_deg, double p_deg, double r_deg) {
  constexpr double kDegree = EIGEN_PI / 180;
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(r_deg * kDegree, Vector3d::UnitZ()) *
          AngleAxisd(p_deg * kDegree, Vector3d::UnitY()) *
          AngleAxisd(w_deg * kDegree, Vector3d::UnitX()))
      .normalized();
}

}  // namespace arcstart::robot_pose
