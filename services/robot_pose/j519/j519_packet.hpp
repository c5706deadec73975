// FANUC Stream Motion (J519): the packets that a listener sends and understands. Big-endian,
// packed.
//
// Of what a client may send there are three here: start (200), stop (2) and the question for the
// controller's capability (7). There is no motion command (201), and none may come.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcstart::robot_pose {

constexpr std::uint32_t kJ519Oldest = 3, kJ519Newest = 4;  // versions understood

std::vector<std::uint8_t> j519_start(std::uint32_t version);
std::vector<std::uint8_t> j519_stop(std::uint32_t version);
std::vector<std::uint8_t> j519_capability_question();

// Type 202 (version 3, 388 bytes) or 204 (version 4, 416 bytes).
struct J519Status {
  std::uint32_t version = 0, sequence = 0;
  std::uint32_t time_stamp = 0;      // the controller's; ms, wraps
  std::array<double, 9> position{};  // X Y Z mm, W P R deg, E1-E3
  std::array<double, 9> joints{};    // deg
};

// The answer to the question.
struct J519Capability {
  std::uint32_t sampling_ms = 0;        // between two reports
  std::uint32_t available_version = 0;  // the newest that the controller has
  bool tool = false;  // positions are the tool centre point's (rob_status_use_tcp 1), else the
                      // flange's
};

struct DecodedJ519 {
  std::optional<J519Status> status;
  std::optional<J519Capability> capability;
  std::string error;  // why there is neither: one line
};

// Any bytes, any number of them.
DecodedJ519 decode_j519(std::span<const std::uint8_t> datagram);

}  // namespace arcstart::robot_pose
