// A folder of calibration images and poses:
//
//     FOLDER/plate.yaml      pattern: circles | asymmetric_circles | chessboard, columns, rows,
//                            pitch_mm, radius_mm, origin_dot_radius_mm
//     FOLDER/poses.csv       index,x,y,z,qw,qx,qy,qz: tool in base; mm
//     FOLDER/grid/NNNN.png   the plate, laser off; .jpg, .jpeg, .bmp, .tif, .tiff as well
//     FOLDER/laser/NNNN.png  the stripe on it; no such folder where grid/ shows both
#pragma once

#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "services/calibration/files/calibration_set_error.hpp"
#include "services/calibration/target/target.hpp"

namespace arcstart::calibration {

struct CalibrationPose {
  int index = 0;
  std::string grid, laser;  // image files, one and the same where one image shows both
  RigidTransform T_base_tool;
};

struct CalibrationSet {
  Target plate;
  std::vector<CalibrationPose> poses;  // by index
};

// Throws CalibrationSetError: something missing, images and poses that do not pair, numbers that
// cannot be, a length unit slipped.
CalibrationSet read_calibration_set(const std::string& folder);

}  // namespace arcstart::calibration
