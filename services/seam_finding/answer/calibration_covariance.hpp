// What a point owes to the calibration: the same error for all points of a scan that are seen
// alike.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/calibration.hpp"

namespace arcstart::seam_finding {

// A point as the sensor saw it.
struct SeenPoint {
  double u = 0, v = 0;                                      // distorted, as seen; px
  RigidTransform T_base_tool = RigidTransform::Identity();  // at utime + time_offset
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();       // of the tool then, in base; mm/s
};

// J Sigma_calibration J^T of the point's place in base, mm2: J from central differences of Eq. 1 in
// the calibration's 19 parameters, the time offset through the tool's velocity. To first order a
// seam's start moves as the point there does, for the error changes little over the plates about
// it. Nothing where the calibration has no covariance or does not carry the pixel to a point.
std::optional<Eigen::Matrix3d> calibration_covariance(const Calibration& calibration,
                                                      const SeenPoint& point);

}  // namespace arcstart::seam_finding
