// Which way round a plate was seen that looks the same after a turn.
#pragma once

#include <vector>

#include "common/geometry.hpp"
#include "services/calibration/target/target.hpp"
#include "services/calibration/target/view.hpp"

namespace arcstart::calibration {

// Relabels the views' targets, and turns T_camera_plate with them, so that between views the camera
// turned by the angles by which the robot did. Plates without symmetry stay as they are.
void settle_target_symmetry(const Target& plate, std::vector<View>& views,
                            std::vector<RigidTransform>& T_camera_plate);

}  // namespace arcstart::calibration
