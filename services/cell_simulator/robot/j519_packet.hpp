// Bytes of FANUC's Stream Motion (J519), the controller's side: what it sends, and what of a
// client's it understands. Big-endian, packed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "services/cell_simulator/robot/fanuc_m20ia.hpp"

namespace arcstart::cell_simulator {

struct J519Place {
  std::uint32_t version = 4;     // 3: type 202, 388 bytes; 4: type 204, 416 bytes
  std::uint32_t sequence = 0;    // wraps
  std::uint32_t time_stamp = 0;  // ms, wraps
  XyzWpr position{};
  Joints joints_deg{};  // as the stream counts them
};
std::vector<std::uint8_t> j519_status_bytes(const J519Place& place);

// 28 bytes. use_tcp: positions are the tool centre point's, else the flange's.
std::vector<std::uint8_t> j519_capability_bytes(std::uint32_t sampling_ms, std::uint32_t version,
                                                bool use_tcp);

enum class J519Request { kStart, kStop, kCapability };
struct J519Asked {
  J519Request what;
  std::uint32_t version;
};
// Nothing for all else, a motion command among it.
std::optional<J519Asked> understand_j519(const std::vector<std::uint8_t>& datagram);

}  // namespace arcstart::cell_simulator
