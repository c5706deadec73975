// What a pose's images show: the plate's points and the stripe.
#pragma once

#include <opencv2/core.hpp>

#include "services/calibration/files/calibration_set.hpp"
#include "services/calibration/target/view.hpp"

namespace arcstart::calibration {

// grid: laser off, or both in one, in grey; laser: the same or another, in the laser's channel. 8
// bit.
View detect_view(const CalibrationPose& pose, const Target& plate, const cv::Mat& grid,
                 const cv::Mat& laser);

}  // namespace arcstart::calibration
