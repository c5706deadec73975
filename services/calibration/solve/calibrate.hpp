// The calibration as a whole, from what each pose showed to the set and what can be believed of it.
#pragma once

#include <vector>

#include "services/calibration/solve/calibration_run.hpp"

namespace arcstart::calibration {

// views: all poses, with what was found in their images. width, height: of the full sensor; px.
CalibrationRun calibrate(const Target& plate, const std::vector<View>& views, int width, int height,
                         const CalibrateOptions& options = {});

}  // namespace arcstart::calibration
