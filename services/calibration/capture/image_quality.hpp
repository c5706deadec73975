// Whether a pose's images can be used for a calibration, and if not, what to change.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "services/calibration/target/view.hpp"

namespace arcstart::calibration {

// Of the plate's image: too dark, too bright or blurred within the plate's points (distorted px).
// Of the stripe's: not on the plate, or saturated. One line, empty where both are good.
std::string image_trouble(const View& view, const cv::Mat& grid, const cv::Mat& laser);

}  // namespace arcstart::calibration
