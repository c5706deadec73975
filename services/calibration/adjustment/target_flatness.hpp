// How far the plate's points stand out of its plane, as all views together tell.
#pragma once

#include <vector>

#include "services/calibration/adjustment/adjustment.hpp"

namespace arcstart::calibration {

struct TargetFlatness {
  std::vector<double> height_mm;  // of each point, towards the camera; mean and tilt removed
  double bend_mm = 0;             // highest less lowest
  double deviation_mm = 0;        // standard deviation of a height
};

TargetFlatness target_flatness(const Target& plate, const std::vector<View>& views,
                               const AdjustmentState& state);

}  // namespace arcstart::calibration
