// HSPO packets put together byte by byte from the layout's table, apart from the decoder.
#pragma once

#include "tests/robot_pose/wire_bytes.hpp"

namespace arcstart::test {

inline Bytes header(std::uint32_t index, std::uint32_t clock, std::uint32_t types) {
  return Bytes().u32(1).u32(index).u32(clock).u16(types);
}

inline std::vector<std::uint8_t> tool_packet(std::uint32_t index, std::uint32_t clock,
                                             float x = 985, std::uint32_t group = 1) {
  Bytes bytes = header(index, clock, 1).u16(group);
  for (const float value : {x, 0.f, 940.f, 180.f, 0.f, 0.f}) bytes.f32(value);
  return bytes.u32(0).u32(0).data;
}

inline std::vector<std::uint8_t> joint_packet(std::uint32_t index, std::uint32_t clock) {
  Bytes bytes = header(index, clock, 4).u16(1);
  for (int i = 1; i <= 9; ++i) bytes.f32(0.1f * static_cast<float>(i));
  return bytes.u32(0).u32(0).data;
}

}  // namespace arcstart::test
