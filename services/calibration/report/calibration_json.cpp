#include "services/calibration/report/calibration_json.hpp"

#include <cmath>

namespace arcstart::calibration {
namespace {

using nlohmann::json;

json list(const Eigen::VectorXd& values) {
  return std::vector<double>(values.data(), values.data() + values.size());
}

json transform(const RigidTransform& pose) {
  double position[3], quaternion[4];
  transform_to_arrays(pose, position, quaternion);
  return {{"position", position}, {"quaternion", quaternion}};
}

json judged(const LeaveOneOut& figures) {
  return {{"laser_rms", figures.laser_rms_mm},
          {"laser_median", figures.laser_median_mm},
          {"laser_95", figures.laser_95_mm},
          {"target_rms", figures.target_rms_mm}};
}

json poses(const CalibrationRun& run) {
  json result = json::array();
  const Adjustment& adjustment = run.adjustment;
  for (std::size_t i = 0; i < run.views.size() && i < adjustment.robot.size(); ++i) {
    json pose{{"pose", run.views[i].index},
              {"camera_residual", adjustment.pixel_rms[i]},
              {"laser_residual", adjustment.laser_rms_mm[i]},
              {"robot_correction_mm", list(adjustment.robot[i].translation)},
              {"robot_correction_rad", list(adjustment.robot[i].rotation)}};
    if (i < run.left_one_out.view_laser_rms_mm.size())
      pose["leave_one_out"] = run.left_one_out.view_laser_rms_mm[i];
    result.push_back(pose);
  }
  return result;
}

json set(const CalibrationRun& run) {
  const AdjustmentState& state = run.adjustment.state;
  const SensorModel& model = state.model;
  json result{
      {"camera_matrix", {model.fx, model.fy, model.cx, model.cy}},
      {"distortion", model.distortion},
      {"T_tool_camera", transform(state.T_tool_camera)},
      {"T_base_plate", transform(state.T_base_plate)},
      {"standard_deviations", list(run.adjustment.covariance.diagonal().cwiseMax(0).cwiseSqrt())}};
  if (run.has_laser) {
    const Plane& plane = model.laser_plane;
    result["laser_plane"] = {plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.offset};
  }
  return result;
}

}  // namespace

json to_json(const CalibrationRun& run, const std::vector<std::string>& missed) {
  json left_out = json::array();
  for (const LeftOutView& view : run.left_out)
    left_out.push_back({{"pose", view.index}, {"why", view.why}});
  json result{{"verdict", !run.refused.empty() ? "refused"
                          : missed.empty()     ? "passed"
                                               : "failed"},
              {"left_out", left_out},
              {"warnings", run.warnings},
              {"advice", run.advice},
              {"spread",
               {{"tilt_deg", run.spread.tilt_deg},
                {"rotation_deg", run.spread.rotation_deg},
                {"roll_deg", run.spread.roll_deg},
                {"axis_ratio", run.spread.axis_ratio},
                {"poses", run.spread.views}}}};
  if (!run.refused.empty()) {
    result["reason"] = run.refused;
    return result;
  }
  const Adjustment& adjustment = run.adjustment;
  result["missed"] = missed;
  result["set"] = set(run);
  result["camera_residual"] = adjustment.camera_rms;
  result["camera_stage_residual"] = run.camera.rms;
  result["camera_held"] = run.camera_held;
  result["hand_eye_residual"] = run.hand_eye_residual_mm;
  result["robot_deviation_mm"] = adjustment.deviations.robot_mm;
  result["robot_deviation_rad"] = adjustment.deviations.robot_rad;
  result["plate_scale"] = {{"factor", run.scale.factor}, {"deviation", run.scale.deviation}};
  result["plate_bend_mm"] = run.flatness.bend_mm;
  result["leave_one_out"] = judged(run.left_one_out);
  result["leave_one_out_park"] = judged(run.plain_left_one_out);
  for (const HandEyeMethod& method : run.methods)
    result["closed_forms"][method.name] =
        std::isfinite(method.consistency_mm) ? json(method.consistency_mm) : json();
  result["poses"] = poses(run);
  if (!run.has_laser) return result;
  result["laser_plane_residual"] = adjustment.laser_rms;
  result["laser_plane_residual_apart"] = run.laser_apart.rms_mm;
  result["crossings"] = {{"count", run.crossings}, {"rms_mm", run.crossing_rms_mm}};
  double worst = 0;
  for (const PredictedError& error : run.field) {
    worst = std::max(worst, error.axes_mm.norm());
    result["predicted"].push_back({{"pixel", list(error.pixel)},
                                   {"camera_point", list(error.point)},
                                   {"axes_mm", list(error.axes_mm)},
                                   {"longest_axis_in_tool", list(error.longest_axis)}});
  }
  result["predicted_worst_mm"] = worst;
  return result;
}

}  // namespace arcstart::calibration
