#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <array>

#include "common/configuration.hpp"
#include "services/calibration/files/calibration_file.hpp"

namespace arcstart::calibration {
namespace {

template <class Numbers>
std::string list(const Numbers& numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

std::string quoted(const std::string& text) {
  YAML::Emitter out;
  out << YAML::DoubleQuoted << text;
  return out.c_str();
}

}  // namespace

std::string calibration_file_text(const Calibration& calibration) {
  const SensorModel& model = calibration.sensor_model;
  const Plane& plane = model.laser_plane;
  std::array<double, 3> position{};
  std::array<double, 4> quaternion{};
  transform_to_arrays(calibration.T_tool_camera, position.data(), quaternion.data());
  std::string text;
  const auto add = [&text](const char* key, const std::string& value) {
    text += fmt::format("{}: {}\n", key, value);
  };
  add("sensor", quoted(calibration.sensor));
  add("robot", quoted(calibration.robot));
  add("tool", quoted(calibration.tool));
  add("made", fmt::format("{}", calibration.made));
  add("origin", quoted(calibration.origin));
  add("width", fmt::format("{}", model.width));
  add("height", fmt::format("{}", model.height));
  add("camera_matrix", list(std::array{model.fx, model.fy, model.cx, model.cy}));
  add("distortion", list(model.distortion));
  add("laser_plane",
      list(std::array{plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.offset}));
  add("camera_position", list(position));
  add("camera_quaternion", list(quaternion));
  add("time_offset", fmt::format("{}", calibration.time_offset));
  add("camera_residual", fmt::format("{}", calibration.camera_residual));
  add("laser_plane_residual", fmt::format("{}", calibration.laser_plane_residual));
  add("hand_eye_residual", fmt::format("{}", calibration.hand_eye_residual));
  const CalibrationVerdict& verdict = calibration.verdict;
  if (verdict.passed != CalibrationVerdict::Passed::kNotJudged) {
    add("verdict", verdict.passed == CalibrationVerdict::Passed::kPassed ? "passed" : "failed");
    add("limits", list(std::array{verdict.camera_limit, verdict.laser_plane_limit,
                                  verdict.leave_one_out_limit, verdict.predicted_limit,
                                  verdict.robot_position_limit, verdict.robot_orientation_limit}));
    add("poses", fmt::format("{}", verdict.poses));
    add("forced_by", quoted(verdict.forced_by));
  }
  if (!calibration.covariance.empty()) add("covariance", list(calibration.covariance));
  return "# arcstart calibration\nid: " + fingerprint(text) + "\n" + text;
}

}  // namespace arcstart::calibration
