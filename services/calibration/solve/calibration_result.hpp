// What comes out of a calibration: the set for the cell's file, and whether it is good enough.
#pragma once

#include <string>
#include <vector>

#include "common/calibration.hpp"
#include "services/calibration/solve/calibration_limits.hpp"
#include "services/calibration/solve/calibration_run.hpp"

namespace arcstart::calibration {

struct CalibrationNames {
  std::string sensor = "LASER0", robot = "ROBOT0", tool = "TCP1";
  double time_offset = 0;  // s; images at rest say nothing of it
  std::int64_t made = 0;   // us, UTC
};

// The set with residuals and covariance, without an id, not judged. The run was not refused and has
// a laser.
Calibration to_calibration(const CalibrationRun& run, const CalibrationNames& names);

// Passed where no limit is missed. forced_by: who wants one in use all the same that failed.
CalibrationVerdict verdict_of(const CalibrationRun& run, const CalibrationLimits& limits,
                              const std::string& forced_by = "");

// RMS distance of the plate's points, carried to base with what the robot said, from where the set
// puts them; mm.
double hand_eye_residual(const Target& plate, const CalibrationRun& run);

// Which limits the run misses, a line each; none where it passes.
std::vector<std::string> missed_limits(const CalibrationRun& run, const CalibrationLimits& limits);

}  // namespace arcstart::calibration
