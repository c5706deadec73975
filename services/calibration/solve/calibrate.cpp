#include "services/calibration/solve/calibrate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/geometry.hpp"
#include "services/calibration/adjustment/view_outliers.hpp"
#include "services/calibration/solve/quality_assessment.hpp"
#include "services/calibration/stages/pose_slips.hpp"
#include "services/calibration/stages/scale_consistency.hpp"
#include "services/calibration/stages/target_symmetry.hpp"

namespace arcstart::calibration {
namespace {

// Of a view. A centre is an average over its kernel's length, and a stripe's own errors run on for
// longer: more of them would count one error many times over.
constexpr int kStripePoints = 40;
constexpr std::size_t kFewestStripes = 3;
constexpr double kLeastLaserSpread = 0.02;
constexpr std::size_t kFewestCameraViews = 3;

std::vector<RigidTransform> tool_poses(const std::vector<View>& views) {
  std::vector<RigidTransform> poses;
  for (const View& view : views) poses.push_back(view.T_base_tool);
  return poses;
}

void keep_usable(const std::vector<View>& views, CalibrationRun& run) {
  for (const View& view : views)
    if (view.unusable.empty())
      run.views.push_back(view);
    else
      run.left_out.push_back({view.index, view.unusable});
}

// Camera, without the views whose grid no camera could show so.
void find_camera(const Target& plate, int width, int height, CalibrationRun& run) {
  for (;;) {
    run.camera = calibrate_camera(plate, run.views, width, height);
    const auto odd = odd_image(run.camera.view_rms);
    if (!odd || run.views.size() <= kFewestCameraViews) return;
    run.left_out.push_back(
        {run.views[*odd].index,
         fmt::format("its grid does not fit the camera: {:.2f} px rms, all together {:.2f}: glare, "
                     "blur or a false detection",
                     run.camera.view_rms[*odd], run.camera.rms)});
    run.views.erase(run.views.begin() + static_cast<std::ptrdiff_t>(*odd));
  }
}

// All poses, with where the camera saw the plate in those whose image fits it.
std::vector<PairedPose> paired_poses(const std::vector<View>& views, const CalibrationRun& run) {
  std::vector<PairedPose> poses;
  for (const View& view : views) {
    poses.push_back({view.T_base_tool, {}});
    for (std::size_t i = 0; i < run.views.size(); ++i)
      if (run.views[i].index == view.index)
        poses.back().T_camera_plate = run.camera.T_camera_plate[i];
  }
  return poses;
}

void leave_out(CalibrationRun& run, std::size_t view, const std::string& why) {
  run.left_out.push_back({run.views[view].index, why});
  const auto offset = static_cast<std::ptrdiff_t>(view);
  run.views.erase(run.views.begin() + offset);
  run.camera.T_camera_plate.erase(run.camera.T_camera_plate.begin() + offset);
  run.camera.view_rms.erase(run.camera.view_rms.begin() + offset);
}

void leave_out_wrong_turns(CalibrationRun& run) {
  for (;;) {
    const auto disagreement = angle_disagreement(tool_poses(run.views), run.camera.T_camera_plate);
    const auto odd = odd_turn(disagreement);
    if (!odd) return;
    leave_out(run, *odd,
              fmt::format("the robot's orientation does not fit the image, by {:.1f} deg: another "
                          "pose's image, or the plate was turned",
                          disagreement[*odd] / kDegree));
  }
}

// The stripes, the plane fitted for itself, the grid's crossings. Why not, where there is none.
std::string find_laser_plane(const Target& plate, CalibrationRun& run) {
  std::vector<Eigen::Vector3d> points;
  std::size_t stripes = 0;
  double squares = 0;
  for (std::size_t i = 0; i < run.views.size(); ++i) {
    View& view = run.views[i];
    const bool seen = !view.stripe.empty();
    view.stripe = straight_stripe(run.camera.model, view.stripe, kStripePoints);
    if (seen && view.stripe.empty())
      run.warnings.push_back(fmt::format("pose {}: no straight stripe on the plate", view.index));
    stripes += !view.stripe.empty();
    const auto on_plate =
        stripe_on_plate(run.camera.model, run.camera.T_camera_plate[i], view.stripe);
    points.insert(points.end(), on_plate.begin(), on_plate.end());
    for (const double difference :
         crossing_differences(run.camera.model, plate, run.camera.T_camera_plate[i], view)) {
      squares += difference * difference;
      ++run.crossings;
    }
  }
  run.has_laser = stripes > 0;
  if (!run.has_laser) return "";
  if (stripes < kFewestStripes)
    return fmt::format("{} poses show a stripe, at least {} are needed", stripes, kFewestStripes);
  if (run.crossings > 0) run.crossing_rms_mm = std::sqrt(squares / run.crossings);
  run.laser_apart = fit_laser_plane(points);
  run.camera.model.laser_plane = run.laser_apart.plane;
  if (run.laser_apart.spread < kLeastLaserSpread)
    return "the stripes lie nearly on one line, which is no plane: vary distance and tilt";
  return "";
}

std::string adjust_all(const Target& plate, CalibrationRun& run) {
  for (;;) {
    run.spread = pose_diversity(run.camera.T_camera_plate);
    if (const std::string refusal = diversity_refusal(run.spread); !refusal.empty()) return refusal;
    run.camera_held = camera_must_be_held(run.spread);
    run.methods =
        closed_form_hand_eye(tool_poses(run.views), run.camera.T_camera_plate, plate.points());
    const HandEyeMethod& first = best_method(run.methods);
    if (!std::isfinite(first.consistency_mm))
      return "no closed form of the hand-eye works: add poses tilted to other sides";
    run.scale = scale_consistency(tool_poses(run.views), run.camera.T_camera_plate,
                                  first.T_tool_camera.linear());
    if (is_gross(run.scale)) return length_slip(run.scale, plate);
    Deviations deviations;
    deviations.pixel = std::max(0.02, run.camera.rms / std::numbers::sqrt2);
    if (run.has_laser) deviations.laser_mm = std::max(0.01, run.laser_apart.rms_mm);
    // The robot is believed at first: where both a good robot and a bad one could explain the data,
    // the good one is likelier.
    deviations.robot_mm = 0.1;
    deviations.robot_rad = 2e-4;
    run.adjustment = adjust(
        plate, run.views,
        {run.camera.model, first.T_tool_camera, first.T_base_plate, run.camera.T_camera_plate},
        deviations, {!run.camera_held, true});
    if (const auto odd = odd_stripe(run.adjustment.laser_rms_mm)) {
      run.warnings.push_back(fmt::format(
          "pose {}: its stripe lies {:.2f} mm from the laser plane, RMS, and is left out: another "
          "light, a reflection, or not on the plate",
          run.views[*odd].index, run.adjustment.laser_rms_mm[*odd]));
      run.views[*odd].stripe.clear();
      continue;
    }
    const auto odd = odd_pose(run.adjustment);
    if (!odd) return "";
    const RobotCorrection& correction = run.adjustment.robot[*odd];
    leave_out(run, *odd,
              fmt::format("the robot's position does not fit the others: {:.2f} mm and {:.3f} deg "
                          "off, a pose's deviation is {:.2f} mm and {:.3f} deg",
                          correction.translation.norm(), correction.rotation.norm() / kDegree,
                          run.adjustment.deviations.robot_mm,
                          run.adjustment.deviations.robot_rad / kDegree));
  }
}

}  // namespace

CalibrationRun calibrate(const Target& plate, const std::vector<View>& views, int width, int height,
                         const CalibrateOptions& options) {
  CalibrationRun run;
  keep_usable(views, run);
  if (run.views.size() < kFewestCameraViews) {
    run.refused = fmt::format("{} of {} poses are usable: a camera needs {}, a calibration more",
                              run.views.size(), views.size(), kFewestCameraViews);
    return run;
  }
  options.progress("camera");
  try {
    find_camera(plate, width, height, run);
  } catch (const std::runtime_error& error) {
    run.refused = error.what();
    return run;
  }
  run.spread = pose_diversity(run.camera.T_camera_plate);
  run.refused = diversity_refusal(run.spread);
  if (run.refused.empty()) run.refused = pose_slip(plate, paired_poses(views, run));
  if (!run.refused.empty()) return run;
  settle_target_symmetry(plate, run.views, run.camera.T_camera_plate);
  leave_out_wrong_turns(run);
  run.spread = pose_diversity(run.camera.T_camera_plate);
  run.refused = diversity_refusal(run.spread);
  if (run.refused.empty()) run.refused = find_laser_plane(plate, run);
  if (!run.refused.empty()) return run;
  options.progress("adjustment");
  run.refused = adjust_all(plate, run);
  if (run.refused.empty()) assess_quality(plate, options, run);
  return run;
}

}  // namespace arcstart::calibration
