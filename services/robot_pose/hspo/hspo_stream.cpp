#include "services/robot_pose/hspo/hspo_stream.hpp"

#include <fmt/core.h>

#include "common/xyzwpr.hpp"

namespace arcstart::robot_pose {

HspoStream::HspoStream(double clock_tick_us, int motion_group)
    : motion_group_(motion_group),
      sequence_(clock_tick_us, "set robot_pose.clock_tick_us", counts_, last_error_) {}

std::optional<ReportedPosition> HspoStream::take(std::span<const std::uint8_t> datagram,
                                                 std::int64_t arrival_utime) {
  ++counts_.received;
  const DecodedHspo decoded = decode_hspo(datagram);
  if (!decoded.packet) {
    ++counts_.malformed;
    last_error_ = decoded.error;
    return std::nullopt;
  }
  const ReceivedHspo& packet = *decoded.packet;
  if (packet.motion_group && *packet.motion_group != motion_group_) {
    ++counts_.foreign;
    last_error_ = fmt::format("positions of motion group {} come, group {} is wanted",
                              *packet.motion_group, motion_group_);
    return std::nullopt;
  }
  if (!sequence_.take({packet.index, packet.clock, arrival_utime, packet.types}))
    return std::nullopt;
  if (sequence_.begins()) joints_.reset();
  if (packet.joints) joints_ = {packet.clock, *packet.joints};
  return position(packet);
}

std::optional<ReportedPosition> HspoStream::position(const ReceivedHspo& packet) {
  if (!packet.tool) {
    if (seen_tool_) return std::nullopt;  // joints in a packet of their own
    ++counts_.foreign;
    last_error_ = fmt::format(
        "packets of type {} come and none with the actual tool centre point: set type 1 in the "
        "controller",
        packet.types);
    return std::nullopt;
  }
  seen_tool_ = true;

  ReportedPosition reported;
  reported.source = RobotProtocol::kHspo;
  const auto& tool = *packet.tool;
  reported.position = {tool[0], tool[1], tool[2]};
  reported.rotation = rotation_from_wpr(tool[3], tool[4], tool[5]);
  if (joints_ && joints_->clock == packet.clock)
    reported.joints.assign(joints_->values.begin(), joints_->values.end());
  sequence_.stamp(reported);
  return reported;
}

}  // namespace arcstart::robot_pose
