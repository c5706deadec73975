#include "services/robot_pose/hspo_packet.hpp"

#include <fmt/core.h>

#include <bit>
#include <cmath>

namespace arcstart::robot_pose {
namespace {

constexpr std::size_t kHeader = 14;           // version, index, clock, types
constexpr std::size_t kToolSection = 34;      // group, 6 values, status, I/O
constexpr std::size_t kJointSection = 46;     // group, 9 values, status, I/O
constexpr std::size_t kVariableSection = 40;  // 10 values
constexpr std::uint16_t kAllTypes = 31;

// Reads on from byte to byte; the caller has checked that they are there.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return number(4); }
  double f32() { return std::bit_cast<float>(number(4)); }
  void skip(std::size_t count) { at_ += count; }

 private:
  std::uint32_t number(int count) {
    std::uint32_t value = 0;
    for (; count > 0; --count) value = value << 8 | bytes_[at_++];
    return value;
  }
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

DecodedHspo refused(std::string why) { return {std::nullopt, std::move(why)}; }

std::size_t size_of(std::uint16_t types) {
  std::size_t size = kHeader;
  if (types & hspo_type::kActualTool) size += kToolSection;
  if (types & hspo_type::kCommandedTool) size += kToolSection;
  if (types & hspo_type::kActualJoints) size += kJointSection;
  if (types & hspo_type::kCommandedJoints) size += kJointSection;
  if (types & hspo_type::kVariables) size += kVariableSection;
  return size;
}

template <std::size_t N>
std::array<double, N> read_values(Reader& reader) {
  std::array<double, N> values;
  for (double& value : values) value = reader.f32();
  return values;
}

template <std::size_t N>
bool all_finite(const std::optional<std::array<double, N>>& values) {
  if (values)
    for (const double value : *values)
      if (!std::isfinite(value)) return false;
  return true;
}

}  // namespace

DecodedHspo decode_hspo(std::span<const std::uint8_t> datagram) {
  if (!datagram.empty() && datagram[0] == '<')
    return refused(
        "the controller sends HSPO in its XML form, which is not understood: switch it to binary");
  if (datagram.size() < kHeader)
    return refused(fmt::format("HSPO packet of {} bytes is cut short: its header alone has {}",
                               datagram.size(), kHeader));
  Reader reader(datagram);
  ReceivedHspo packet;
  // One source splits this word into a version (0) and a count, so its low half says nothing sure.
  if (const std::uint32_t version = reader.u32(); version >> 16 != 0)
    return refused(fmt::format("not an HSPO packet: it begins with {:08x}", version));
  packet.index = reader.u32();
  packet.clock = reader.u32();
  packet.types = reader.u16();
  if (packet.types == 0 || (packet.types & ~kAllTypes) != 0)
    return refused(fmt::format("HSPO packet of unknown type {}", packet.types));
  if (const std::size_t expected = size_of(packet.types); datagram.size() != expected)
    return refused(fmt::format("HSPO packet of type {} has {} bytes and must have {}", packet.types,
                               datagram.size(), expected));

  for (const std::uint16_t type : {hspo_type::kActualTool, hspo_type::kCommandedTool,
                                   hspo_type::kActualJoints, hspo_type::kCommandedJoints}) {
    if (!(packet.types & type)) continue;
    const std::uint16_t group = reader.u16();
    if (packet.motion_group && *packet.motion_group != group)
      return refused(
          fmt::format("HSPO packet mixes motion groups {} and {}", *packet.motion_group, group));
    packet.motion_group = group;
    if (type == hspo_type::kActualTool) {
      packet.tool = read_values<6>(reader);
    } else if (type == hspo_type::kActualJoints) {
      packet.joints = read_values<9>(reader);
    } else {
      reader.skip(type == hspo_type::kCommandedTool ? 24 : 36);
    }
    reader.skip(8);  // status and I/O
  }
  if (!all_finite(packet.tool) || !all_finite(packet.joints))
    return refused("HSPO packet holds a position that is not finite");
  return {packet, {}};
}

}  // namespace arcstart::robot_pose
