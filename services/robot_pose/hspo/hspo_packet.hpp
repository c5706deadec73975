// FANUC High Speed Position Output (option R891): the bytes of one datagram. Big-endian, packed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace arcstart::robot_pose {

// Type bits of a packet: which sections it holds, in ascending order of bits.
namespace hspo_type {
constexpr std::uint16_t kActualTool = 1;
constexpr std::uint16_t kCommandedTool = 2;
constexpr std::uint16_t kActualJoints = 4;
constexpr std::uint16_t kCommandedJoints = 8;
constexpr std::uint16_t kVariables = 16;
}  // namespace hspo_type

struct ReceivedHspo {
  std::uint32_t index = 0;  // counts the packets, wraps
  std::uint32_t clock = 0;  // the controller's, in its ticks, wraps
  std::uint16_t types = 0;
  std::optional<std::uint16_t> motion_group;  // nothing where no section has one
  std::optional<std::array<double, 6>> tool;  // actual; X Y Z mm, W P R deg, in the robot's World
  std::optional<std::array<double, 9>>
      joints;  // actual; J1..J9 rad, J3 as the controller counts it
};

struct DecodedHspo {
  std::optional<ReceivedHspo> packet;
  std::string error;  // why there is none: one line
};

// Any bytes, any number of them. Commanded sections and variables are checked for their size and
// skipped: commanded positions run ahead of the arm by 84 to 180 ms and never serve as measured
// ones.
DecodedHspo decode_hspo(std::span<const std::uint8_t> datagram);

}  // namespace arcstart::robot_pose
