#include "common/bus/calibration_message.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart {

static_assert(static_cast<int>(CalibrationVerdict::Passed::kNotJudged) ==
              calibration_t::NOT_JUDGED);
static_assert(static_cast<int>(CalibrationVerdict::Passed::kPassed) == calibration_t::PASSED);
static_assert(static_cast<int>(CalibrationVerdict::Passed::kFailed) == calibration_t::FAILED);

calibration_t to_message(const Calibration& calibration) {
  const SensorModel& model = calibration.sensor_model;
  calibration_t message{};
  message.utime = calibration.made;
  message.id = calibration.id;
  message.sensor = calibration.sensor;
  message.robot = calibration.robot;
  message.tool = calibration.tool;
  message.width = model.width;
  message.height = model.height;
  Eigen::Map<Eigen::Vector4d>{message.camera_matrix} << model.fx, model.fy, model.cx, model.cy;
  std::copy(model.distortion.begin(), model.distortion.end(), message.distortion);
  Eigen::Map<Eigen::Vector4d>{message.laser_plane} << model.laser_plane.normal,
      model.laser_plane.offset;
  const Eigen::Matrix<double, 4, 3> matrix = pixel_to_camera(model);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 3; ++column)
      message.pixel_to_camera[row][column] = matrix(row, column);
  transform_to_arrays(calibration.T_tool_camera, message.camera_position,
                      message.camera_quaternion);
  message.time_offset = calibration.time_offset;
  message.camera_residual = calibration.camera_residual;
  message.laser_plane_residual = calibration.laser_plane_residual;
  message.hand_eye_residual = calibration.hand_eye_residual;
  const CalibrationVerdict& verdict = calibration.verdict;
  message.passed = static_cast<std::int8_t>(verdict.passed);
  message.camera_limit = verdict.camera_limit;
  message.laser_plane_limit = verdict.laser_plane_limit;
  message.leave_one_out_limit = verdict.leave_one_out_limit;
  message.predicted_limit = verdict.predicted_limit;
  message.robot_position_limit = verdict.robot_position_limit;
  message.robot_orientation_limit = verdict.robot_orientation_limit;
  message.poses = verdict.poses;
  message.forced_by = verdict.forced_by;
  constexpr int n = Calibration::kParameters;
  static_assert(n == calibration_t::PARAMETERS);
  message.covariance_size = calibration.covariance.empty() ? 0 : n;
  message.covariance.assign(static_cast<std::size_t>(message.covariance_size), {});
  for (int row = 0; row < message.covariance_size; ++row)
    message.covariance[static_cast<std::size_t>(row)].assign(
        calibration.covariance.begin() + row * n, calibration.covariance.begin() + (row + 1) * n);
  message.origin = calibration.origin;
  return message;
}

Calibration calibration_from_message(const calibration_t& message) {
  Calibration calibration;
  calibration.id = message.id;
  calibration.sensor = message.sensor;
  calibration.robot = message.robot;
  calibration.tool = message.tool;
  calibration.made = message.utime;
  calibration.origin = message.origin;
  SensorModel& model = calibration.sensor_model;
  model.width = message.width;
  model.height = message.height;
  model.fx = message.camera_matrix[0];
  model.fy = message.camera_matrix[1];
  model.cx = message.camera_matrix[2];
  model.cy = message.camera_matrix[3];
  std::copy_n(message.distortion, model.distortion.size(), model.distortion.begin());
  model.laser_plane.normal = Eigen::Map<const Eigen::Vector3d>(message.laser_plane);
  model.laser_plane.offset = message.laser_plane[3];
  const double length = Eigen::Map<const Eigen::Vector4d>(message.camera_quaternion).squaredNorm();
  if (!(std::abs(length - 1) < 1e-6))
    throw CalibrationError("the camera's quaternion must have length 1");
  calibration.T_tool_camera =
      transform_from_arrays(message.camera_position, message.camera_quaternion);
  calibration.time_offset = message.time_offset;
  calibration.camera_residual = message.camera_residual;
  calibration.laser_plane_residual = message.laser_plane_residual;
  calibration.hand_eye_residual = message.hand_eye_residual;
  CalibrationVerdict& verdict = calibration.verdict;
  if (message.passed < calibration_t::NOT_JUDGED || message.passed > calibration_t::FAILED)
    throw CalibrationError("its judgement is unknown");
  verdict.passed = static_cast<CalibrationVerdict::Passed>(message.passed);
  verdict.camera_limit = message.camera_limit;
  verdict.laser_plane_limit = message.laser_plane_limit;
  verdict.leave_one_out_limit = message.leave_one_out_limit;
  verdict.predicted_limit = message.predicted_limit;
  verdict.robot_position_limit = message.robot_position_limit;
  verdict.robot_orientation_limit = message.robot_orientation_limit;
  verdict.poses = message.poses;
  verdict.forced_by = message.forced_by;

  for (const auto& row : message.covariance)
    calibration.covariance.insert(calibration.covariance.end(), row.begin(), row.end());

  if (const std::string error = calibration_error(calibration); !error.empty())
    throw CalibrationError(error);
  // Another build may round otherwise in the last bits; any real difference is far larger.
  constexpr double kTolerance = 1e-12;
  const Eigen::Matrix<double, 4, 3> expected = pixel_to_camera(model);
  for (int row = 0; row < 4; ++row) {
    const Eigen::RowVector3d sent =
        Eigen::Map<const Eigen::RowVector3d>(message.pixel_to_camera[row]);
    if (!((sent - expected.row(row)).norm() <= kTolerance * expected.row(row).norm()))
      throw CalibrationError("its matrix M does not follow from its camera and laser plane");
  }
  return calibration;
}

}  // namespace arcstart
