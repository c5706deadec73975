#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "services/calibration/solve/calibrate.hpp"

namespace arcstart::calibration {

// All figures of a run; mm, px and rad, keys as calibration_t has them where it does. missed:
// limits that it missed.
nlohmann::json to_json(const CalibrationRun& run, const std::vector<std::string>& missed);

}  // namespace arcstart::calibration
