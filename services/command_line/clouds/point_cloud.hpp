// A point cloud as a file holds it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "common/input_error.hpp"

namespace arcstart::command_line {

// "cloud.pcd: header promises 500 points of 12 bytes, the file holds 120 bytes: it is cut off"
class PointCloudFileError : public InputError {
 public:
  using InputError::InputError;
};

struct PointCloud {
  std::vector<Eigen::Vector3d> points;       // finite, in the file's unit
  std::size_t skipped = 0;                   // points with a coordinate that is no finite number
  std::optional<Eigen::Vector3d> viewpoint;  // PCD's VIEWPOINT where it is not the default
};

}  // namespace arcstart::command_line
