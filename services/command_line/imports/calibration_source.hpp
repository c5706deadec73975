// Calibration images and poses as other programs leave them, made into a folder for arcstart
// calibrate.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "services/command_line/imports/pose_file.hpp"

namespace arcstart::command_line {

struct CalibrationSource {
  std::string plate;                    // plate.yaml
  std::map<int, RigidTransform> poses;  // T_base_tool by the images' numbers
  std::map<int, std::string> grid;      // image files, one a pose
  std::map<int, std::string> laser;     // likewise; none where grid shows both
};

// Poses: FOLDER/poses.csv, its first column index, or a file a pose in FOLDER/poses or FOLDER,
// .txt, .yaml or .yml, whose name ends with the pose's number and whose numbers are the pose; where
// they have names, the names must be the format's. Images: FOLDER/grid, FOLDER/images or FOLDER,
// their names ending with the number, and FOLDER/laser. plate: FOLDER/plate.yaml where empty.
// Images without a pose are left out and told in notes. Throws ImportError.
CalibrationSource read_calibration_source(const std::string& folder, const std::string& plate,
                                          const PoseConvention& convention,
                                          std::vector<std::string>& notes);

// plate.yaml, poses.csv, and links to the images in grid/ and laser/. The folder must not be there;
// nothing is left of it where it cannot be made, or could not be read as a calibration set. Throws
// ImportError, calibration::CalibrationSetError.
void write_calibration_folder(const CalibrationSource& source, const std::string& folder);

}  // namespace arcstart::command_line
