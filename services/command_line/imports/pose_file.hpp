// poses.csv: where the robot held its tool, and when.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry.hpp"

namespace arcstart::command_line {

struct StampedPose {
  std::int64_t utime = 0;  // us, UTC
  RigidTransform T_base_tool = RigidTransform::Identity();
};

struct PoseConvention {
  std::string format = "wxyz";  // of pose_formats()
  std::string unit = "mm";      // of length_units()
};

// At least two poses, their times rising. What is odd but can be goes into notes, a line each.
// Throws ImportError.
std::vector<StampedPose> read_pose_file(const std::string& path, const PoseConvention& convention,
                                        std::vector<std::string>& notes);

}  // namespace arcstart::command_line
