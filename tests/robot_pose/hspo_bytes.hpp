// HSPO packets put together byte by byte from the layout's table, apart from the decoder.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace arcstart::test {

class Bytes {
 public:
  Bytes& u16(std::uint32_t value) {
    for (const int shift : {8, 0}) data.push_back(static_cast<std::uint8_t>(value >> shift));
    return *this;
  }
  Bytes& u32(std::uint32_t value) { return u16(value >> 16).u16(value & 0xffff); }
  Bytes& f32(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return u32(bits);
  }
  std::vector<std::uint8_t> data;
};

inline std::vector<std::uint8_t> from_hex(const std::string& text) {
  std::vector<std::uint8_t> bytes;
  std::string digits;
  for (const char c : text)
    if (c != ' ') digits += c;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  return bytes;
}

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
