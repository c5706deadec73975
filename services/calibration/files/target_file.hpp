// plate.yaml and poses.csv of a calibration folder.
#pragma once

#include <map>
#include <string>

#include "common/geometry.hpp"
#include "services/calibration/target/target.hpp"

namespace arcstart::calibration {

// Throws CalibrationSetError.
Target read_target_file(const std::string& path);

// T_base_tool by index. Throws CalibrationSetError.
std::map<int, RigidTransform> read_poses_file(const std::string& path);

}  // namespace arcstart::calibration
