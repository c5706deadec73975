#include "common/calibration.hpp"

#include <cmath>

namespace arcstart {
namespace {

std::string covariance_error(const std::vector<double>& covariance) {
  constexpr std::size_t n = Calibration::kParameters;
  if (covariance.empty()) return "";
  if (covariance.size() != n * n) return "the covariance must have 19 rows of 19 numbers";
  for (const double number : covariance)
    if (!std::isfinite(number)) return "the covariance is not finite";
  constexpr double kTolerance = 1e-9;
  for (std::size_t i = 0; i < n; ++i) {
    if (covariance[i * n + i] < 0) return "the covariance has a variance below 0";
    for (std::size_t j = 0; j < i; ++j) {
      const double limit = std::sqrt(covariance[i * n + i] * covariance[j * n + j]);
      if (std::abs(covariance[i * n + j] - covariance[j * n + i]) > kTolerance * limit ||
          std::abs(covariance[i * n + j]) > (1 + kTolerance) * limit)
        return "the covariance is not symmetric or says more than 1 of a correlation";
    }
  }
  return "";
}

std::string verdict_error(const CalibrationVerdict& verdict) {
  constexpr std::size_t kLongestName = 128;  // bytes
  for (const double limit :
       {verdict.camera_limit, verdict.laser_plane_limit, verdict.leave_one_out_limit,
        verdict.predicted_limit, verdict.robot_position_limit, verdict.robot_orientation_limit})
    if (!std::isfinite(limit) || (limit < 0 && limit != -1))
      return "a limit must not be below 0, or be -1 where there is none";
  if (verdict.poses < -1) return "the number of poses must not be below 0, or be -1";
  if (verdict.forced_by.size() > kLongestName)
    return "the name of who forced it must not be longer than 128 bytes";
  if (!verdict.forced_by.empty() && verdict.passed != CalibrationVerdict::Passed::kFailed)
    return "only one that failed can be forced";
  return "";
}

}  // namespace

std::string calibration_error(const Calibration& calibration) {
  constexpr double kLongestLever = 1e4;  // mm: no camera sits ten metres from its tool
  constexpr double kLongestOffset = 10;  // s: as long as positions are kept
  if (calibration.id.empty()) return "it has no id";
  if (calibration.made <= 0) return "it does not say when it was made";
  if (std::string error = sensor_model_error(calibration.sensor_model); !error.empty())
    return error;
  if (!calibration.T_tool_camera.matrix().allFinite() ||
      calibration.T_tool_camera.translation().norm() > kLongestLever)
    return "the camera's place in tool is not finite or more than 10 m away";
  if (!(std::abs(calibration.time_offset) < kLongestOffset))
    return "the time offset must lie within 10 s";
  for (const double residual : {calibration.camera_residual, calibration.laser_plane_residual,
                                calibration.hand_eye_residual})
    if (!std::isfinite(residual) || (residual < 0 && residual != -1))
      return "a residual must not be below 0, or be -1 where it is not known";
  if (std::string error = verdict_error(calibration.verdict); !error.empty()) return error;
  return covariance_error(calibration.covariance);
}

std::string distrust(const CalibrationVerdict& verdict) {
  switch (verdict.passed) {
    case CalibrationVerdict::Passed::kPassed:
      return "";
    case CalibrationVerdict::Passed::kFailed:
      return verdict.forced_by.empty()
                 ? "it failed its limits"
                 : "it failed its limits, and was forced into use by " + verdict.forced_by;
    case CalibrationVerdict::Passed::kNotJudged:
      break;
  }
  return "it has no verdict: it was made before calibrations kept one";
}

std::string instance_error(const Calibration& calibration, const std::string& sensor,
                           const std::string& robot) {
  if (calibration.sensor != sensor)
    return "it is of sensor " + calibration.sensor + ", this is " + sensor;
  if (calibration.robot != robot)
    return "it is of robot " + calibration.robot + ", this is " + robot;
  return "";
}

}  // namespace arcstart
