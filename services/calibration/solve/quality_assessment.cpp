#include "services/calibration/solve/quality_assessment.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "services/calibration/adjustment/robot_prior.hpp"
#include "services/calibration/solve/calibration_result.hpp"

namespace arcstart::calibration {
namespace {

void warn_of_method_spread(CalibrationRun& run) {
  const double largest = spread_of_methods(run.methods);
  const double own =
      std::sqrt(run.adjustment.covariance.diagonal().tail<3>().sum());  // mm, predicted
  if (largest > std::max(1.0, 5 * own))
    run.warnings.push_back(
        fmt::format("closed forms of the hand-eye lie up to {:.2f} mm apart: the poses say little, "
                    "or some are wrong",
                    largest));
}

// What follows from the adjustment.
void describe(const Target& plate, CalibrationRun& run) {
  run.hand_eye_residual_mm = hand_eye_residual(plate, run);
  run.flatness = target_flatness(plate, run.views, run.adjustment.state);
  run.field = predicted_field(run.adjustment.state, run.adjustment.covariance, run.views);
}

}  // namespace

void assess_quality(const Target& plate, const CalibrateOptions& options, CalibrationRun& run) {
  warn_of_method_spread(run);
  if (const std::string slip = length_slip(run.scale, plate); !slip.empty())
    run.warnings.push_back(slip);
  if (!run.adjustment.converged)
    run.warnings.emplace_back(
        "the adjustment did not settle: its deviations are not to be relied on");
  if (run.camera_held)
    run.warnings.push_back(fmt::format(
        "camera held as the camera stage found it: {} views that turn by {:.0f} deg do not tell "
        "camera and hand-eye apart",
        run.spread.views, run.spread.rotation_deg));
  run.advice = diversity_advice(run.spread);
  describe(plate, run);
  if (run.flatness.bend_mm > std::max(0.05, 6 * run.flatness.deviation_mm))
    run.warnings.push_back(
        fmt::format("the plate is not flat: its points lie within {:.2f} mm; use "
                    "a plate of glass or thick aluminium",
                    run.flatness.bend_mm));
  if (!options.leave_one_out) return;
  const auto say = [&](std::size_t view) {
    options.progress(fmt::format("without pose {} of {}", view + 1, run.views.size()));
  };
  run.left_one_out = leave_one_out(plate, run.views, [&](std::size_t view) {
    say(view);
    return adjusted_without(plate, run.views, run.adjustment, !run.camera_held, view);
  });
  run.plain_left_one_out = leave_one_out(plate, run.views, [&](std::size_t view) {
    say(view);
    return plain_without(plate, run.views, run.camera.model, view);
  });
  const auto figure = [&](const LeaveOneOut& of) {
    return run.has_laser ? of.laser_rms_mm : of.target_rms_mm;
  };
  if (figure(run.plain_left_one_out) < figure(run.left_one_out)) {
    options.progress("how far to believe the robot");
    const ValidatedAdjustment held = held_by_validation(
        plate, run.views, {run.adjustment, run.left_one_out, 1}, !run.camera_held, figure);
    if (held.share < 1)
      run.warnings.push_back(fmt::format(
          "the robot's errors are not by chance from pose to pose (a plate of another size, a "
          "mount "
          "that gives, wrong stamps): the robot is held by {:.2f} of what they look like, which "
          "tells unseen poses best",
          held.share));
    run.adjustment = held.adjustment;
    run.left_one_out = held.left_one_out;
    describe(plate, run);
  }
  if (figure(run.plain_left_one_out) < 0.95 * figure(run.left_one_out))
    run.warnings.push_back(fmt::format(
        "Park and plain fits tell poses that they never saw better than the adjustment, {:.3f} "
        "against {:.3f} mm: something is wrong that is not by chance, from pose to pose",
        figure(run.plain_left_one_out), figure(run.left_one_out)));
}

}  // namespace arcstart::calibration
