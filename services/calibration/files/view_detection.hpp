// What a pose's images show: the plate's points and the stripe.
#pragma once

#include <opencv2/core.hpp>

#include "services/calibration/files/calibration_set.hpp"
#include "services/calibration/target/view.hpp"

namespace arcstart::calibration {

// grid: laser off, or both in one; laser: may be the same. Grey, 8 bit.
View look_at_pose(const CalibrationPose& pose, const Plate& plate, const cv::Mat& grid,
                  const cv::Mat& laser);

}  // namespace arcstart::calibration
