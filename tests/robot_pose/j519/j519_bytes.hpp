// J519 packets put together from the table of their layout, by offset.
#pragma once

#include "tests/robot_pose/wire_bytes.hpp"

namespace arcstart::test {

// 388 bytes for version 3, 416 for version 4; joint n is n degrees.
inline std::vector<std::uint8_t> j519_status(std::uint32_t version, std::uint32_t sequence,
                                             std::uint32_t stamp_ms, float x = 985) {
  Bytes bytes;
  bytes.u32(version == 3 ? 202 : 204).u32(version).u32(sequence).u32(0x05000000).u32(stamp_ms);
  for (const float value : {x, 0.f, 940.f, 180.f, 0.f, 0.f, 0.f, 0.f, 0.f}) bytes.f32(value);
  for (int joint = 1; joint <= 9; ++joint) bytes.f32(static_cast<float>(joint));
  bytes.zeros(36).f32(1);
  if (version != 3) bytes.zeros(28);
  return bytes.zeros(256).data;
}

inline std::vector<std::uint8_t> j519_capability(std::uint32_t available, std::uint32_t use_tcp,
                                                 std::uint32_t sampling_ms = 8) {
  return Bytes().u32(7).u32(3).u32(1).u32(sampling_ms).u32(0).u32(available).u32(use_tcp).data;
}

}  // namespace arcstart::test
