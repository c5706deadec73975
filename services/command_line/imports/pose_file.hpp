// poses.csv: where the robot held its tool, and when.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "services/command_line/imports/csv_table.hpp"

namespace arcstart::command_line {

struct StampedPose {
  std::int64_t utime = 0;  // us, UTC
  RigidTransform T_base_tool = RigidTransform::Identity();
};

struct PoseConvention {
  std::string format = "wxyz";  // of pose_formats()
  std::string unit = "mm";      // of length_units()
};

// A table whose first column names the pose, and whose others are one in the convention given.
struct PoseTable {
  CsvTable table;
  std::vector<RigidTransform> T_base_tool;  // of each row
};

// first: what the first column is called. What is odd but can be goes into notes, a line each.
// Throws ImportError.
PoseTable read_pose_table(const std::string& path, const std::string& first,
                          const PoseConvention& convention, std::vector<std::string>& notes);

// Throws ImportError where the positions can hardly be in this unit.
void refuse_other_unit(const std::vector<RigidTransform>& poses, const PoseConvention& convention,
                       const std::string& path);

// At least two poses, their times rising. What is odd but can be goes into notes, a line each.
// Throws ImportError.
std::vector<StampedPose> read_pose_file(const std::string& path, const PoseConvention& convention,
                                        std::vector<std::string>& notes);

}  // namespace arcstart::command_line
