// What is to be said of an adjusted calibration: residuals, poses it never saw, warnings, advice.
#pragma once

#include "services/calibration/solve/calibration_run.hpp"

namespace arcstart::calibration {

// Fills what of the run follows from its adjustment. Where the plain way tells unseen poses better,
// the adjustment is made anew with the robot held tighter.
void assess_quality(const Target& plate, const CalibrateOptions& options, CalibrationRun& run);

}  // namespace arcstart::calibration
