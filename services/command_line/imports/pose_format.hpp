// How a table of poses writes a position and an orientation, and what its columns are called.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/geometry.hpp"

namespace arcstart::command_line {

enum class PoseFormat { kWxyz, kXyzw, kWpr, kRotvec, kMatrix };

// By the names of --pose-format and --pose-units.
const std::map<std::string, PoseFormat>& pose_formats();
const std::map<std::string, double>& length_units();  // mm

// The columns after the time: "x,y,z,qw,qx,qy,qz"; of a matrix the names are free.
std::string pose_columns(PoseFormat format);

// Whether a pose of this format may have so many numbers.
bool is_pose_size(PoseFormat format, std::size_t numbers);

// T_base_tool of a pose's numbers (finite, of a size that may be), a unit of length being unit_mm.
//     wxyz, xyzw  quaternion, of unit length within 1e-3
//     wpr         FANUC's W, P, R: Rz(R) Ry(P) Rx(W), fixed axes; degrees
//     rotvec      Universal Robots' rotation vector: axis times angle; rad, at most 2 pi
//     matrix      [R t] row by row, 12 numbers, or 16 with the row 0 0 0 1
// why: what is wrong and what to do, empty where nothing is.
RigidTransform pose_of(PoseFormat format, double unit_mm, std::span<const double> numbers,
                       std::string& why);

// What a header contradicts in this format and unit; empty where it fits. Capitals do not count. A
// column may tell its unit: x_mm, w_deg, rx_rad. first: what the column before the pose is called.
std::string header_error(PoseFormat format, const std::string& unit,
                         const std::vector<std::string>& header,
                         const std::string& first = "utime");

}  // namespace arcstart::command_line
