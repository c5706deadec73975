#include "services/robot_pose/hspo/hspo_packet.hpp"

#include <fmt/core.h>

#include <cmath>

#include "services/robot_pose/stream/big_endian.hpp"

namespace arcstart::robot_pose {
namespace {

constexpr std::size_t kHeader = 14;           // version, index, clock, types
constexpr std::size_t kToolSection = 34;      // group, 6 values, status, I/O
constexpr std::size_t kJointSection = 46;     // group, 9 values, status, I/O
constexpr std::size_t kVariableSection = 40;  // 10 values
constexpr std::uint16_t kAllTypes = 31;

DecodedHspo refused_hspo(std::string why) { return {std::nullopt, std::move(why)}; }

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
bool all_finite(const std::optional<std::array<double, N>>& values) {
  if (values)
    for (const double value : *values)
      if (!std::isfinite(value)) return false;
  return true;
}

}  // namespace

DecodedHspo decode_hspo(std::span<const std::uint8_t> datagram) {
  if (!datagram.empty() && datagram[0] == '<')
    return refused_hspo(
        "the controller sends HSPO in its XML form, which is not understood: switch it to binary");
  if (datagram.size() < kHeader)
    return refused_hspo(fmt::format("HSPO packet of {} bytes is cut short: its header alone has {}",
                                    datagram.size(), kHeader));
  BigEndianReader reader(datagram);
  ReceivedHspo packet;
  // One source splits this word into a version (0) and a count, so its low half says nothing sure.
  if (const std::uint32_t version = reader.u32(); version >> 16 != 0)
    return refused_hspo(fmt::format("not an HSPO packet: it begins with {:08x}", version));
  packet.index = reader.u32();
  packet.clock = reader.u32();
  packet.types = reader.u16();
  if (packet.types == 0 || (packet.types & ~kAllTypes) != 0)
    return refused_hspo(fmt::format("HSPO packet of unknown type {}", packet.types));
  if (const std::size_t expected = size_of(packet.types); datagram.size() != expected)
    return refused_hspo(fmt::format("HSPO packet of type {} has {} bytes and must have {}",
                                    packet.types, datagram.size(), expected));

  for (const std::uint16_t type : {hspo_type::kActualTool, hspo_type::kCommandedTool,
                                   hspo_type::kActualJoints, hspo_type::kCommandedJoints}) {
    if (!(packet.types & type)) continue;
    const std::uint16_t group = reader.u16();
    if (packet.motion_group && *packet.motion_group != group)
      return refused_hspo(
          fmt::format("HSPO packet mixes motion groups {} and {}", *packet.motion_group, group));
    packet.motion_group = group;
    if (type == hspo_type::kActualTool) {
      reader.f32s(packet.tool.emplace());
    } else if (type == hspo_type::kActualJoints) {
      reader.f32s(packet.joints.emplace());
    } else {
      reader.skip(type == hspo_type::kCommandedTool ? 24 : 36);
    }
    reader.skip(8);  // status and I/O
  }
  if (!all_finite(packet.tool) || !all_finite(packet.joints))
    return refused_hspo("HSPO packet holds a position that is not finite");
  return {packet, {}};
}

}  // namespace arcstart::robot_pose
