#include "services/calibration/adjustment/leave_one_out.hpp"

#include <algorithm>
#include <cmath>

#include "services/calibration/stages/hand_eye.hpp"
#include "services/calibration/stages/intrinsics_stage.hpp"
#include "services/calibration/stages/laser_plane_stage.hpp"

namespace arcstart::calibration {
namespace {

template <class T>
std::vector<T> without(std::vector<T> values, std::size_t left_out) {
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(left_out));
  return values;
}

// Nearest rank.
double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(1, rank) - 1];
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

LeaveOneOut leave_one_out(const Target& plate, const std::vector<View>& views,
                          const CalibrateWithout& calibrate) {
  LeaveOneOut result;
  std::vector<double> laser, target;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const AdjustmentState state = calibrate(i);
    const RigidTransform T_base_camera = views[i].T_base_tool * state.T_tool_camera;
    const RigidTransform T_plate_camera = state.T_base_plate.inverse() * T_base_camera;
    std::vector<double> distances;
    for (const Eigen::Vector2d& pixel : views[i].stripe)
      if (const auto point = camera_point(state.model, pixel.x(), pixel.y()))
        distances.push_back(std::abs((T_plate_camera * *point).z()));
    laser.insert(laser.end(), distances.begin(), distances.end());
    result.view_laser_rms_mm.push_back(root_mean_square(distances));
    const RigidTransform seen = locate_plate(state.model, plate, views[i]);
    for (const Eigen::Vector3d& point : plate.points())
      target.push_back((T_plate_camera * (seen * point) - point).norm());
  }
  result.laser_rms_mm = root_mean_square(laser);
  result.laser_median_mm = percentile(laser, 0.5);
  result.laser_95_mm = percentile(laser, 0.95);
  result.target_rms_mm = root_mean_square(target);
  return result;
}

AdjustmentState adjusted_without(const Target& plate, const std::vector<View>& views,
                                 const Adjustment& adjustment, bool camera_free,
                                 std::size_t left_out) {
  AdjustmentState start = adjustment.state;
  start.T_camera_plate = without(start.T_camera_plate, left_out);
  return adjust(plate, without(views, left_out), start, adjustment.deviations, {camera_free, false})
      .state;
}

AdjustmentState plain_without(const Target& plate, const std::vector<View>& views,
                              const SensorModel& guess, std::size_t left_out) {
  const std::vector<View> others = without(views, left_out);
  const IntrinsicsStage camera = calibrate_camera(plate, others, guess.width, guess.height, &guess);
  std::vector<RigidTransform> T_base_tool;
  std::vector<Eigen::Vector3d> laser;
  for (std::size_t i = 0; i < others.size(); ++i) {
    T_base_tool.push_back(others[i].T_base_tool);
    const auto points = stripe_on_plate(camera.model, camera.T_camera_plate[i], others[i].stripe);
    laser.insert(laser.end(), points.begin(), points.end());
  }
  AdjustmentState state;
  state.model = camera.model;
  if (!laser.empty()) state.model.laser_plane = fit_laser_plane(laser).plane;
  const HandEyeMethod park =
      closed_form_hand_eye(T_base_tool, camera.T_camera_plate, plate.points())[1];
  state.T_tool_camera = park.T_tool_camera;
  state.T_base_plate = park.T_base_plate;
  return state;
}

}  // namespace arcstart::calibration
