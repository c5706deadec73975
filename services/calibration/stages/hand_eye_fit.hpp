// A hand-eye in closed form with the robot's length unit left free, and how well it fits.
#pragma once

#include <optional>
#include <vector>

#include "services/calibration/stages/pose_readings.hpp"
#include "services/calibration/target/target.hpp"

namespace arcstart::calibration {

struct HandEyeFit {
  double factor = 1;     // by which the plate's lengths fit the robot's moves; negative: mirrored
  double deviation = 0;  // its standard deviation
  RigidTransform T_tool_camera = RigidTransform::Identity();
  RigidTransform T_base_plate = RigidTransform::Identity();
  // Median over the poses of how far the plate's points, carried to base, lie from where the fit
  // puts them, RMS of each; in the plate's mm. Infinite where nothing could be fitted.
  double misfit_mm = 0;
};

// Rotation by Procrustes over the turns between poses (as Park and Martin, 1994), then positions,
// all by least squares, over the poses that show the plate; again over those that agree, so that a
// few wrong ones change nothing. factor: held where given. A plate that looks the same after a turn
// is turned as the poses want it.
HandEyeFit fit_hand_eye(const Target& plate, const std::vector<PairedPose>& poses,
                        std::optional<double> factor = std::nullopt);

// Whether the positions alone fit the images: RMS of how far a point fixed to the camera, wherever
// it be, lies from what the robot says, by any placing of the plate; mm. Orientations are not
// looked at. Nothing where fewer than eight poses show the plate.
std::optional<double> position_misfit(const std::vector<PairedPose>& poses);

}  // namespace arcstart::calibration
