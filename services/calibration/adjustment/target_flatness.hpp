// How far the plate's points stand out of its plane, as all views together tell.
#pragma once

#include <vector>

#include "services/calibration/adjustment/adjustment.hpp"

namespace arcstart::calibration {

struct PlateFlatness {
  std::vector<double> height_mm;  // of each point, towards the camera; mean and tilt removed
  double bend_mm = 0;             // highest less lowest
  double deviation_mm = 0;        // standard deviation of a height
};

PlateFlatness plate_flatness(const Plate& plate, const std::vector<View>& views,
                             const AdjustmentState& state);

}  // namespace arcstart::calibration
