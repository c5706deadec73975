// Point clouds as files: PCD, PLY, and text with a point a line.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "services/command_line/clouds/point_cloud.hpp"

namespace arcstart::command_line {

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
