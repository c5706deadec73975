// The cell of the synthetic recordings in closed form: how its camera moves, and what its laser
// lights.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/bus/calibration_message.hpp"
#include "tests/command_line/support/synthetic_recording.hpp"

namespace arcstart::test {

using namespace command_line;

constexpr double kTimeOffset = -0.02732;  // s

Calibration calibration_of_cell(const std::string& sensor, const std::string& robot);

// The camera looks at the line of the seam from 300 mm, leaning 38 deg over the open side, its rows
// along the stripe. `seconds` after kBegin.
RigidTransform T_base_camera(double seconds);

struct SurfacePoint {
  Eigen::Vector3d position;  // in base; mm
  std::int16_t segment;
};

// Where the laser plane (in base) meets what the camera sees of the scene, every 0.5 mm.
std::vector<SurfacePoint> lit_points(const Plane& laser, bool with_workpiece);

}  // namespace arcstart::test
