// How well points will be known with a calibration, from its covariance.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/calibration/adjustment/adjustment.hpp"

namespace arcstart::calibration {

// Covariance of a laser point in tool from the calibration alone, robot and stripe taken as exact;
// mm squared. Rotated into base it is the error in base.
Eigen::Matrix3d predicted_covariance(const AdjustmentState& state, const SetCovariance& covariance,
                                     const Eigen::Vector2d& pixel);

// Root of the mean over the pixels of the squared length of the predicted error; mm. Pixels that do
// not show the laser plane are left out.
double predicted_rms(const AdjustmentState& state, const SetCovariance& covariance,
                     const std::vector<Eigen::Vector2d>& pixels);

struct PredictedError {
  Eigen::Vector2d pixel;
  Eigen::Vector3d point;         // in camera; mm
  Eigen::Vector3d axes_mm;       // standard deviations along the ellipsoid's axes, longest first
  Eigen::Vector3d longest_axis;  // in tool, unit
};

// Over the pixels where the views saw their stripes, about 7 by 7 of them.
std::vector<PredictedError> predicted_field(const AdjustmentState& state,
                                            const SetCovariance& covariance,
                                            const std::vector<View>& views);

}  // namespace arcstart::calibration
