// Whether the robot's quaternions were given x, y, z, w for w, x, y, z.
#pragma once

#include <string>
#include <vector>

#include "services/calibration/stages/hand_eye.hpp"

namespace arcstart::calibration {

// What is to be said where no hand-eye fits the robot's orientations as they stand and one does
// once the order is changed; empty else. The angles between poses tell nothing: the other order
// leaves them as they are. points: in plate; mm.
std::string quaternion_slip(const std::vector<RigidTransform>& T_base_tool,
                            const std::vector<RigidTransform>& T_camera_plate,
                            const std::vector<Eigen::Vector3d>& points);

}  // namespace arcstart::calibration
