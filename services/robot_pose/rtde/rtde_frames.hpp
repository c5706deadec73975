// Universal Robots' RTDE, protocol version 2: its frames. Each is u16 size (header included), u8
// type, payload; big-endian, packed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcstart::robot_pose {

namespace rtde_type {
constexpr std::uint8_t kVersion = 'V', kOutputs = 'O', kStart = 'S', kPause = 'P', kData = 'U',
                       kText = 'M';
}

std::vector<std::uint8_t> rtde_version_request();  // of version 2
// names: joined by commas, in the order in which data come.
std::vector<std::uint8_t> rtde_outputs_request(double rate_hz, const std::string& names);
std::vector<std::uint8_t> rtde_request(std::uint8_t type);  // start, pause

struct RtdeFrame {
  std::uint8_t type = 0;
  std::vector<std::uint8_t> payload;
};

// Cuts what comes through a TCP connection into frames.
class RtdeFrameReader {
 public:
  void add(std::span<const std::uint8_t> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  // The next whole frame; nothing where there is none yet, or where what comes is no RTDE.
  std::optional<RtdeFrame> next();

  // Why nothing more can be understood: one line; empty while all is well.
  const std::string& error() const { return error_; }

  std::size_t waiting() const { return bytes_.size(); }  // bytes of a frame that is not whole

 private:
  std::vector<std::uint8_t> bytes_;
  std::string error_;
};

// Answer to the outputs request: the recipe's number and a type for each name; NOT_FOUND for one
// that the controller does not know, IN_USE for one that another client holds.
struct RtdeRecipe {
  std::uint8_t id = 0;
  std::vector<std::string> types;
};
std::optional<RtdeRecipe> decode_rtde_recipe(std::span<const std::uint8_t> payload);

// Data for the names timestamp, actual_TCP_pose, actual_q and, where asked for, tcp_offset.
struct RtdeData {
  std::uint8_t recipe = 0;
  double timestamp = 0;            // the controller's clock; s
  std::array<double, 6> pose{};    // tool centre point in base: m, rotation vector rad
  std::array<double, 6> joints{};  // rad
  std::optional<std::array<double, 6>> tool_offset;  // tool centre point in the flange, likewise
};
struct DecodedRtdeData {
  std::optional<RtdeData> data;
  std::string error;
};
DecodedRtdeData decode_rtde_data(std::span<const std::uint8_t> payload, bool with_tool_offset);

// What the controller says in words, made printable; empty where it is none.
std::string decode_rtde_text(std::span<const std::uint8_t> payload);

}  // namespace arcstart::robot_pose
