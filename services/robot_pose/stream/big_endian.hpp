// Numbers as controllers send them: big-endian, packed, IEEE 754.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace arcstart::robot_pose {

// Reads on from byte to byte; the caller has checked that they are there.
class BigEndianReader {
 public:
  explicit BigEndianReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t u8() { return bytes_[at_++]; }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  double f32() { return std::bit_cast<float>(u32()); }
  double f64() { return std::bit_cast<double>(number(8)); }
  template <class Values>
  void f32s(Values& values) {
    for (double& value : values) value = f32();
  }
  template <class Values>
  void f64s(Values& values) {
    for (double& value : values) value = f64();
  }
  void skip(std::size_t count) { at_ += count; }

 private:
  std::uint64_t number(int count) {
    std::uint64_t value = 0;
    for (; count > 0; --count) value = value << 8 | bytes_[at_++];
    return value;
  }
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

class BigEndianWriter {
 public:
  BigEndianWriter& u8(std::uint8_t value) { return number(value, 1); }
  BigEndianWriter& u16(std::uint16_t value) { return number(value, 2); }
  BigEndianWriter& u32(std::uint32_t value) { return number(value, 4); }
  BigEndianWriter& f64(double value) { return number(std::bit_cast<std::uint64_t>(value), 8); }
  BigEndianWriter& text(std::string_view text) {
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    return *this;
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  BigEndianWriter& number(std::uint64_t value, int count) {
    while (count-- > 0) bytes_.push_back(static_cast<std::uint8_t>(value >> 8 * count));
    return *this;
  }
  std::vector<std::uint8_t> bytes_;
};

}  // namespace arcstart::robot_pose
