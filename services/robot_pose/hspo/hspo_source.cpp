#include "services/robot_pose/hspo/hspo_source.hpp"

#include <fmt/core.h>

#include <stdexcept>

namespace arcstart::robot_pose {
namespace {

// A controller so long silent may have been given another address.
constexpr std::int64_t kForgottenAfter = 5'000'000;

}  // namespace

HspoSource::HspoSource(const RobotPoseSettings& settings, std::function<void()> notify)
    : listener_(settings.address, settings.port, std::move(notify)),
      stream_(settings.clock_tick_us, settings.motion_group),
      address_(settings.address),
      tool_in_flange_is_set_(!settings.tool_in_flange.empty()),
      controller_(settings.controller_address),
      controller_is_set_(!settings.controller_address.empty()) {}

void HspoSource::start() {
  if (tool_in_flange_is_set_)
    throw std::runtime_error(
        "robot_pose.tool_in_flange: HSPO reports the tool centre point and not where it lies in "
        "the flange: leave this key away, or take protocol j519 or rtde");
  listener_.start();
}

std::optional<ReportedPosition> HspoSource::poll() {
  while (const auto datagram = listener_.poll()) {
    if (!is_the_controller(*datagram)) continue;
    auto position = stream_.take(datagram->bytes, datagram->arrival_utime);
    if (stream_.last_error() != stream_error_) last_error_ = stream_error_ = stream_.last_error();
    if (position) return position;
  }
  return std::nullopt;
}

PoseSourceCounts HspoSource::counts() const {
  PoseSourceCounts counts = stream_.counts();
  counts.foreign += foreign_;
  counts.lost += listener_.overflowed();
  return counts;
}

std::string HspoSource::description() const {
  return fmt::format("HSPO on UDP {}:{}", address_, listener_.port());
}

std::string HspoSource::why_silent() const {
  return "is the controller on, HSPO enabled ($MCGR_CFG.$ENABLE), and its host address and port "
         "this host's?";
}

// Two controllers on one port would give positions of two arms in turn: one of them is heard.
bool HspoSource::is_the_controller(const Datagram& datagram) {
  const bool forgotten = datagram.arrival_utime - heard_utime_ > kForgottenAfter;
  if (!controller_is_set_ && (controller_.empty() || forgotten)) controller_ = datagram.sender;
  if (datagram.sender == controller_) {
    heard_utime_ = datagram.arrival_utime;
    return true;
  }
  ++foreign_;
  last_error_ =
      fmt::format("packets of {} are ignored, the controller is {}", datagram.sender, controller_);
  return false;
}

}  // namespace arcstart::robot_pose
