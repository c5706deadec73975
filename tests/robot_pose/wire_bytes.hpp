// Packets put together byte by byte from the protocols' tables, apart from the decoders.
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
  Bytes& f64(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return u32(static_cast<std::uint32_t>(bits >> 32)).u32(static_cast<std::uint32_t>(bits));
  }
  Bytes& zeros(std::size_t count) {
    data.insert(data.end(), count, 0);
    return *this;
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

}  // namespace arcstart::test
