#include "services/robot_pose/rtde/rtde_frames.hpp"

#include <fmt/core.h>

#include <cmath>
#include <string_view>

#include "services/robot_pose/stream/big_endian.hpp"

namespace arcstart::robot_pose {
namespace {

constexpr std::size_t kHeaderSize = 3;
constexpr std::string_view kKnownTypes = "VvOISPUM";
constexpr double kFarthestMetres = 100;    // no arm's; turns in rad and joints stay below, too
constexpr double kLatest = 1e9;            // s: a clock of 30 years
constexpr std::size_t kLongestText = 200;  // characters that a message may fill

bool in_range(const std::array<double, 6>& values) {
  for (const double value : values)
    if (!(std::abs(value) < kFarthestMetres)) return false;
  return true;
}

}  // namespace

std::vector<std::uint8_t> rtde_version_request() {
  return BigEndianWriter().u16(5).u8(rtde_type::kVersion).u16(2).take();
}

std::vector<std::uint8_t> rtde_outputs_request(double rate_hz, const std::string& names) {
  const auto size = static_cast<std::uint16_t>(kHeaderSize + 8 + names.size());
  return BigEndianWriter().u16(size).u8(rtde_type::kOutputs).f64(rate_hz).text(names).take();
}

std::vector<std::uint8_t> rtde_request(std::uint8_t type) {
  return BigEndianWriter().u16(kHeaderSize).u8(type).take();
}

std::optional<RtdeFrame> RtdeFrameReader::next() {
  if (bytes_.size() < kHeaderSize || !error_.empty()) return std::nullopt;
  const std::size_t size = BigEndianReader(bytes_).u16();
  const std::uint8_t type = bytes_[2];
  if (size < kHeaderSize || kKnownTypes.find(static_cast<char>(type)) == std::string_view::npos) {
    error_ = fmt::format("what answers is no RTDE, it begins with {:02x} {:02x} {:02x}", bytes_[0],
                         bytes_[1], bytes_[2]);
    return std::nullopt;
  }
  if (bytes_.size() < size) return std::nullopt;
  const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(size);
  RtdeFrame frame{type, {bytes_.begin() + kHeaderSize, end}};
  bytes_.erase(bytes_.begin(), end);
  return frame;
}

std::optional<RtdeRecipe> decode_rtde_recipe(std::span<const std::uint8_t> payload) {
  if (payload.empty()) return std::nullopt;
  RtdeRecipe recipe{payload[0], {""}};
  for (const std::uint8_t c : payload.subspan(1)) {
    if (c == ',')
      recipe.types.emplace_back();
    else
      recipe.types.back() += static_cast<char>(c);
  }
  return recipe;
}

DecodedRtdeData decode_rtde_data(std::span<const std::uint8_t> payload, bool with_tool_offset) {
  const std::size_t expected = 1 + 8 * (1 + 6 + 6 + (with_tool_offset ? 6 : 0));
  if (payload.size() != expected)
    return {{},
            fmt::format("RTDE data package has {} bytes and must have {}",
                        payload.size() + kHeaderSize, expected + kHeaderSize)};
  BigEndianReader reader(payload);
  RtdeData data;
  data.recipe = reader.u8();
  data.timestamp = reader.f64();
  reader.f64s(data.pose);
  reader.f64s(data.joints);
  if (with_tool_offset) reader.f64s(data.tool_offset.emplace());
  if (!(data.timestamp >= 0 && data.timestamp < kLatest))
    return {{}, "RTDE data package holds a time that is none"};
  if (!in_range(data.pose) || !in_range(data.joints) ||
      (data.tool_offset && !in_range(*data.tool_offset)))
    return {{}, "RTDE data package holds a position that is none"};
  return {data, {}};
}

std::string decode_rtde_text(std::span<const std::uint8_t> payload) {
  std::string text;
  if (payload.empty()) return text;
  for (const std::uint8_t c :
       payload.subspan(1, std::min<std::size_t>(payload[0], payload.size() - 1)))
    if (text.size() < kLongestText) text += c >= ' ' && c < 127 ? static_cast<char>(c) : ' ';
  return text;
}

}  // namespace arcstart::robot_pose
