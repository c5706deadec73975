#include "services/calibration/solve/calibration_result.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace arcstart::calibration {

Calibration to_calibration(const CalibrationRun& run, const CalibrationNames& names) {
  const Adjustment& adjustment = run.adjustment;
  Calibration calibration;
  calibration.sensor = names.sensor;
  calibration.robot = names.robot;
  calibration.tool = names.tool;
  calibration.made = names.made;
  calibration.time_offset = names.time_offset;
  calibration.sensor_model = adjustment.state.model;
  calibration.T_tool_camera = adjustment.state.T_tool_camera;
  calibration.camera_residual = adjustment.camera_rms;
  calibration.laser_plane_residual = adjustment.laser_rms;
  calibration.hand_eye_residual = run.hand_eye_residual_mm;
  calibration.origin =
      fmt::format("arcstart calibrate: {} poses, {} left out, leave-one-out {:.3f} mm",
                  run.views.size(), run.left_out.size(), run.left_one_out.laser_rms_mm);
  constexpr int n = Calibration::kParameters;
  const SetCovariance symmetric = (adjustment.covariance + adjustment.covariance.transpose()) / 2;
  calibration.covariance.assign(n * n, 0);  // the time offset was not estimated
  for (int row = 0; row < kSetParameters; ++row)
    for (int column = 0; column < kSetParameters; ++column)
      calibration.covariance[static_cast<std::size_t>(row * n + column)] = symmetric(row, column);
  return calibration;
}

CalibrationVerdict verdict_of(const CalibrationRun& run, const CalibrationLimits& limits,
                              const std::string& forced_by) {
  CalibrationVerdict verdict;
  const bool passed = missed_limits(run, limits).empty();
  verdict.passed =
      passed ? CalibrationVerdict::Passed::kPassed : CalibrationVerdict::Passed::kFailed;
  verdict.camera_limit = limits.camera_residual_px;
  verdict.laser_plane_limit = limits.laser_residual_mm;
  verdict.leave_one_out_limit = limits.leave_one_out_mm;
  verdict.predicted_limit = limits.predicted_deviation_mm;
  verdict.robot_position_limit = limits.robot_deviation_mm;
  verdict.robot_orientation_limit = limits.robot_deviation_deg * std::numbers::pi / 180;
  verdict.poses = static_cast<int>(run.views.size());
  if (!passed) verdict.forced_by = forced_by;
  return verdict;
}

double hand_eye_residual(const Target& plate, const CalibrationRun& run) {
  const AdjustmentState& state = run.adjustment.state;
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < run.views.size(); ++i) {
    const RigidTransform carried = state.T_base_plate.inverse() * run.views[i].T_base_tool *
                                   state.T_tool_camera * state.T_camera_plate[i];
    for (const Eigen::Vector3d& point : plate.points()) {
      sum += (carried * point - point).squaredNorm();
      ++count;
    }
  }
  return std::sqrt(sum / std::max(1, count));
}

std::vector<std::string> missed_limits(const CalibrationRun& run, const CalibrationLimits& limits) {
  std::vector<std::string> missed;
  const auto check = [&](const char* what, double value, double limit, const char* unit,
                         const char* remedy) {
    constexpr double kMeaningful = 1000;  // px, mm, deg: beyond it the figure says nothing
    if (!(value <= limit))
      missed.push_back(fmt::format("{} {} {}, the limit is {} {}: {}", what,
                                   value < kMeaningful ? fmt::format("{:.3f}", value)
                                                       : fmt::format("more than {}", kMeaningful),
                                   unit, limit, unit, remedy));
  };
  const Deviations& found = run.adjustment.deviations;
  check("robot's positions deviate by", found.robot_mm, limits.robot_deviation_mm, "mm",
        "the robot data do not fit the images; wrong stamps, tool, units or a loose mount");
  check("robot's orientations deviate by", found.robot_rad * 180 / std::numbers::pi,
        limits.robot_deviation_deg, "deg",
        "the robot data do not fit the images; wrong stamps, tool, units or a loose mount");
  check("camera residual", run.adjustment.camera_rms, limits.camera_residual_px, "px",
        "blur, glare, or not the plate that plate.yaml describes");
  if (!run.has_laser) return missed;
  check("laser residual", run.adjustment.laser_rms, limits.laser_residual_mm, "mm",
        "a stripe beside the plate, or a plate that is not flat");
  check("leave-one-out", run.left_one_out.laser_rms_mm, limits.leave_one_out_mm, "mm",
        "more poses, better spread, or a better robot");
  double worst = 0;
  for (const PredictedError& error : run.field) worst = std::max(worst, error.axes_mm.norm());
  check("predicted deviation", worst, limits.predicted_deviation_mm, "mm",
        "more poses, better spread");
  return missed;
}

}  // namespace arcstart::calibration
