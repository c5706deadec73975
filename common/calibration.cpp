#include "common/calibration.hpp"

#include <cmath>

namespace arcstart {

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
  return "";
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
