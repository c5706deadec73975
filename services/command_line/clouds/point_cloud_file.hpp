// Point clouds as files: PCD (ascii, binary) and PLY (ascii, binary_little_endian).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
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

// Both throw PointCloudFileError; the format is told by the content, not by the name. Every size of
// the header is checked against the bytes there are before memory is taken for it.
PointCloud read_point_cloud(const std::string& path);
PointCloud parse_point_cloud(std::string_view bytes, const std::string& name);

using Colour = std::array<std::uint8_t, 3>;  // red, green, blue

// Binary files of float x, y, z and, where there are as many colours as points, rgb. Throw
// PointCloudFileError.
void write_pcd(const std::string& path, const std::vector<Eigen::Vector3d>& points,
               const std::vector<Colour>& colours = {});
void write_ply(const std::string& path, const std::vector<Eigen::Vector3d>& points,
               const std::vector<Colour>& colours = {});

}  // namespace arcstart::command_line
