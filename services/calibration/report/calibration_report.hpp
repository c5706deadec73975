// A calibration as a page that a person reads: one HTML file, pictures inside.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "services/calibration/solve/calibrate.hpp"
#include "services/calibration/solve/calibration_limits.hpp"

namespace arcstart::calibration {

// The laser's image of a pose, with the grid where one shows both; empty where there is none.
using PoseImage = std::function<cv::Mat(int index)>;

// views: of all poses, also those that were left out. forced_by: who put one into use that failed,
// empty: nobody.
std::string calibration_report(const std::string& title, const Target& plate,
                               const std::vector<View>& views, const CalibrationRun& run,
                               const CalibrationLimits& limits,
                               const std::vector<std::string>& missed, const std::string& forced_by,
                               const PoseImage& image);

}  // namespace arcstart::calibration
