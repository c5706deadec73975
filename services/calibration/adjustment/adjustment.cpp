#include "services/calibration/adjustment/adjustment.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "services/calibration/adjustment/adjustment_problem.hpp"
#include "services/calibration/adjustment/adjustment_residuals.hpp"
#include "services/calibration/stages/intrinsics_stage.hpp"
#include "services/calibration/stages/laser_plane_stage.hpp"

namespace arcstart::calibration {
namespace {

// Nothing measures better than this: a group whose residuals vanish keeps a weight that can be.
constexpr Deviations kLeast{1e-3, 1e-4, 1e-3, 1e-6};

// Förstner's estimate of variance components: each group's standard deviation by its own residuals
// and redundancy, until they agree. The largest change is given back.
double improve(Deviations& deviations, const Redundancy& redundancy, bool has_laser) {
  double change = 0;
  const auto scale = [&](double& deviation, double least, const Group& group) {
    // A step too long would swing where two groups can explain the same.
    const double factor = std::clamp(group.factor(), 0.2, 5.0);
    const double next = std::max(least, deviation * factor);
    change = std::max(change, std::abs(std::log(next / deviation)));
    deviation = next;
  };
  scale(deviations.pixel, kLeast.pixel, redundancy.pixel);
  if (has_laser) scale(deviations.laser_mm, kLeast.laser_mm, redundancy.laser);
  scale(deviations.robot_mm, kLeast.robot_mm, redundancy.robot_translation);
  scale(deviations.robot_rad, kLeast.robot_rad, redundancy.robot_rotation);
  return change;
}

void describe_residuals(const Target& plate, const std::vector<View>& views,
                        Adjustment& adjustment) {
  const AdjustmentState& state = adjustment.state;
  double pixels = 0, lasers = 0;
  std::size_t laser_count = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double rms =
        root_mean_square(reprojection(state.model, plate, state.T_camera_plate[i], views[i]));
    adjustment.pixel_rms.push_back(rms);
    pixels += rms * rms;
    double sum = 0;
    const auto points = stripe_on_plate(state.model, state.T_camera_plate[i], views[i].stripe);
    for (const Eigen::Vector3d& point : points)
      sum += std::pow(state.model.laser_plane.signed_distance(point), 2);
    adjustment.laser_rms_mm.push_back(
        points.empty() ? 0 : std::sqrt(sum / static_cast<double>(points.size())));
    lasers += sum;
    laser_count += points.size();

    std::array<double, 6> deviation;
    robot_deviation<double>(
        {state.T_camera_plate[i].linear(), state.T_camera_plate[i].translation()},
        state.T_tool_camera.linear(), state.T_tool_camera.translation(),
        state.T_base_plate.linear(), state.T_base_plate.translation(), views[i].T_base_tool,
        deviation.data());
    adjustment.robot.push_back({Eigen::Map<const Eigen::Vector3d>(deviation.data()),
                                Eigen::Map<const Eigen::Vector3d>(deviation.data() + 3), 0, 0});
  }
  adjustment.camera_rms = std::sqrt(pixels / static_cast<double>(views.size()));
  adjustment.laser_rms = laser_count > 0 ? std::sqrt(lasers / static_cast<double>(laser_count)) : 0;
}

}  // namespace

Adjustment adjust(const Target& plate, const std::vector<View>& views, const AdjustmentState& start,
                  const Deviations& deviations, const AdjustmentOptions& options) {
  constexpr int kRounds = 25;
  constexpr double kSettled = 0.01;  // relative change of a standard deviation
  const bool has_laser = std::any_of(views.begin(), views.end(),
                                     [](const View& view) { return !view.stripe.empty(); });
  Adjustment result;
  result.state = start;
  result.deviations = deviations;
  for (int round = 0; round < kRounds && !result.converged; ++round) {
    const AdjustmentState from = result.state;
    AdjustmentProblem problem(plate, views, from, result.deviations, options.camera_free);
    if (!problem.solve()) break;
    result.state = problem.state();
    if (!options.estimate_deviations) {
      result.converged = true;
      break;
    }
    result.converged = improve(result.deviations, problem.redundancy(), has_laser) < kSettled;
  }
  // Once more at the solution: what it holds for, in its own axes.
  describe_residuals(plate, views, result);
  const AdjustmentState solution = result.state;
  const Redundancy redundancy =
      AdjustmentProblem(plate, views, solution, result.deviations, options.camera_free)
          .redundancy();
  result.covariance = redundancy.covariance;
  for (std::size_t i = 0; i < views.size(); ++i) {
    result.robot[i].translation_redundancy = redundancy.view_translation[i];
    result.robot[i].rotation_redundancy = redundancy.view_rotation[i];
  }
  return result;
}

}  // namespace arcstart::calibration
