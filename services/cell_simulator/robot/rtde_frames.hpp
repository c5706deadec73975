// Bytes of Universal Robots' RTDE (protocol version 2), the controller's side.
// A frame: u16 size (header included), u8 type, payload; big-endian, packed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/cell_simulator/robot/robot_controller.hpp"

namespace arcstart::cell_simulator {

struct RtdeRequest {
  char type = 0;  // V, v, O, S, P; others are not understood
  std::vector<std::uint8_t> payload;
};
// Takes the first whole frame off what a client has sent; nothing where there is none. A size
// that no frame has empties it.
std::optional<RtdeRequest> take_rtde_request(std::vector<std::uint8_t>& received);

std::vector<std::uint8_t> rtde_yes_or_no(char type, bool yes);
// Types of the names, joined by commas: NOT_FOUND for one that is not known.
std::vector<std::uint8_t> rtde_recipe_bytes(std::uint8_t recipe, const std::string& types);

// What a client asked for.
struct RtdeOutputs {
  double rate_hz = 0;
  std::vector<std::string> names;
};
std::optional<RtdeOutputs> understand_rtde_outputs(const std::vector<std::uint8_t>& payload);
std::string rtde_type_of(const std::string& name);

// A data package with the values of these names, of which all are known. T_tool0_tool: the tool
// centre point in the flange.
std::vector<std::uint8_t> rtde_data_bytes(std::uint8_t recipe,
                                          const std::vector<std::string>& names,
                                          const RobotReport& report,
                                          const RigidTransform& T_tool0_tool);

// x y z in m and rotation vector in rad, its length 0 to pi.
std::array<double, 6> to_rotation_vector(const RigidTransform& transform);

}  // namespace arcstart::cell_simulator
