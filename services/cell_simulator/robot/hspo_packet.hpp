// Bytes of FANUC's High Speed Position Output (option R891): big-endian, packed, one packet a
// datagram.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace arcstart::cell_simulator {

// One report of the controller. A part that is there sets its type bit and adds its section, in
// ascending order of bits: actual tool centre point (1), actual joints (4).
struct HspoReport {
  std::uint32_t index = 0;  // counts the packets, wraps
  std::uint32_t clock = 0;  // controller's clock in its ticks, wraps
  std::uint16_t motion_group = 1;
  std::optional<std::array<float, 6>> tool;    // X Y Z mm, W P R deg
  std::optional<std::array<float, 9>> joints;  // J1..J9 rad, as the controller counts them
};

// 48 bytes with the tool alone, 60 with the joints alone, 94 with both.
std::vector<std::uint8_t> hspo_packet(const HspoReport& report);

}  // namespace arcstart::cell_simulator
