#include "services/robot_pose/j519/j519_source.hpp"

#include <fmt/core.h>

#include <stdexcept>

#include "common/time.hpp"
#include "services/robot_pose/stream/hand.hpp"

namespace arcstart::robot_pose {
namespace {

constexpr int kJ519Port = 60015;

}  // namespace

J519Source::J519Source(const RobotPoseSettings& settings, std::function<void()> notify)
    : listener_(settings.address, settings.port, std::move(notify)),
      session_(tool_in_flange(settings.tool_in_flange)),
      address_(settings.address),
      controller_(settings.controller_address),
      controller_port_(settings.controller_port ? settings.controller_port : kJ519Port) {}

J519Source::~J519Source() {
  if (const auto stop = session_.stop()) listener_.send(*stop, controller_, controller_port_);
}

void J519Source::start() {
  if (controller_.empty())
    throw std::runtime_error(
        "robot_pose.controller_address: protocol j519 needs the address of the controller");
  if (address_.starts_with("127.") && !controller_.starts_with("127."))
    throw std::runtime_error(fmt::format(
        "robot_pose.address: {} hears this host alone: set this host's address in the network of "
        "the controller {}",
        address_, controller_));
  listener_.start();
}

std::optional<ReportedPosition> J519Source::poll() {
  while (const auto datagram = listener_.poll()) {
    if (datagram->sender != controller_) {
      ++foreign_;
      last_error_ = fmt::format("packets of {} are ignored, the controller is {}", datagram->sender,
                                controller_);
      continue;
    }
    auto position = session_.take(datagram->bytes, datagram->arrival_utime, steady_now());
    if (session_.last_error() != session_error_)
      last_error_ = session_error_ = session_.last_error();
    if (position) return position;
  }
  if (const auto bytes = session_.step(steady_now()))
    listener_.send(*bytes, controller_, controller_port_);
  return std::nullopt;
}

PoseSourceCounts J519Source::counts() const {
  PoseSourceCounts counts = session_.counts();
  counts.foreign += foreign_;
  counts.lost += listener_.overflowed();
  return counts;
}

std::string J519Source::description() const {
  return fmt::format("J519 from {}:{} to UDP {}", controller_, controller_port_, listener_.port());
}

}  // namespace arcstart::robot_pose
