// Whether robot and plate mean the same by a millimetre.
#pragma once

#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "services/calibration/target/target.hpp"

namespace arcstart::calibration {

struct ScaleConsistency {
  double factor = 1;     // of the plate's pitch, so that the robot's moves fit best
  double deviation = 0;  // its standard deviation
};

// From A X = X B between all pairs of views with the camera's moves scaled: least squares for the
// hand-eye's position and the factor, its rotation given.
ScaleConsistency scale_consistency(const std::vector<RigidTransform>& T_base_tool,
                                   const std::vector<RigidTransform>& T_camera_plate,
                                   const Eigen::Matrix3d& hand_eye_rotation);

// What is to be said of a factor that is not 1, empty where it may be.
std::string length_slip(const ScaleConsistency& scale, const Target& plate);

// So far from 1 that nothing can come of the set.
bool is_gross(const ScaleConsistency& scale);

}  // namespace arcstart::calibration
