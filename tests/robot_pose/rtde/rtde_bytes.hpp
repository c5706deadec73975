// RTDE frames put together from the table of their layout.
#pragma once

#include <array>

#include "tests/robot_pose/wire_bytes.hpp"

namespace arcstart::test {

inline std::vector<std::uint8_t> rtde_frame(char type, const std::vector<std::uint8_t>& payload) {
  Bytes bytes;
  bytes.u16(static_cast<std::uint32_t>(payload.size() + 3));
  bytes.data.push_back(static_cast<std::uint8_t>(type));
  bytes.data.insert(bytes.data.end(), payload.begin(), payload.end());
  return bytes.data;
}

inline std::vector<std::uint8_t> rtde_types(std::uint8_t recipe, const std::string& types) {
  std::vector<std::uint8_t> payload{recipe};
  payload.insert(payload.end(), types.begin(), types.end());
  return rtde_frame('O', payload);
}

const std::string kAllVectors = "DOUBLE,VECTOR6D,VECTOR6D,VECTOR6D";
constexpr std::array<double, 6> kPoseMetres{0.985, 0, 0.94, 0, 2, 0};
constexpr std::array<double, 6> kOffsetMetres{0, 0, 0.3, 0, 0, 0};

// timestamp, actual_TCP_pose, actual_q (joint n is n rad) and, where there is one, tcp_offset.
inline std::vector<std::uint8_t> rtde_data(double timestamp,
                                           const std::array<double, 6>& pose = kPoseMetres,
                                           const std::array<double, 6>* offset = &kOffsetMetres,
                                           std::uint8_t recipe = 1) {
  Bytes bytes;
  bytes.data.push_back(recipe);
  bytes.f64(timestamp);
  for (const double value : pose) bytes.f64(value);
  for (int joint = 1; joint <= 6; ++joint) bytes.f64(joint);
  if (offset)
    for (const double value : *offset) bytes.f64(value);
  return rtde_frame('U', bytes.data);
}

inline std::vector<std::uint8_t> rtde_text(const std::string& text) {
  std::vector<std::uint8_t> payload{static_cast<std::uint8_t>(text.size())};
  payload.insert(payload.end(), text.begin(), text.end());
  for (const int byte : {4, int{'R'}, int{'T'}, int{'D'}, int{'E'}, 2})
    payload.push_back(static_cast<std::uint8_t>(byte));
  return rtde_frame('M', payload);
}

}  // namespace arcstart::test
