// FANUC's position packets: any bytes are decoded or refused with a reason; what is decoded is
// finite.
#include <cmath>
#include <cstdlib>

#include "services/robot_pose/hspo_packet.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const arcstart::robot_pose::DecodedHspo decoded = arcstart::robot_pose::decode_hspo({data, size});
  if (decoded.packet.has_value() != decoded.error.empty()) std::abort();
  if (!decoded.packet) return 0;
  const auto check = [](const auto& values) {
    if (!values) return;
    for (const double value : *values)
      if (!std::isfinite(value)) std::abort();
  };
  check(decoded.packet->tool);
  check(decoded.packet->joints);
  return 0;
}
