#include "services/cell_simulator/robot/robot_controller.hpp"

#include <cmath>

#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/robot/hspo_packet.hpp"

namespace arcstart::cell_simulator {
RobotController::RobotController(const RobotControllerSettings& settings, Pose pose)
    : settings_(settings), pose_(std::move(pose)), arm_(settings.T_tool0_tool) {}

RobotReport RobotController::report(std::int64_t instant, std::int64_t clock_back_us) {
  RobotReport report;
  report.number = static_cast<std::uint32_t>(packets_);
  report.clock_ns = settings_.clock.nanoseconds(instant - clock_back_us);
  report.T_base_tool = pose_(instant);
  if (settings_.joints_too) {
    const auto near = joints_ ? arm_.joints(report.T_base_tool, *joints_) : std::nullopt;
    if (const auto joints = near ? near : arm_.joints(report.T_base_tool))
      joints_ = joints;
    else
      ++unreachable_;
    report.joints = joints_.value_or(Joints{});
  }
  RandomStream noise(settings_.seed, packets_++);
  for (int axis = 0; axis < 3; ++axis)
    report.T_base_tool.translation()(axis) += settings_.position_noise * noise.normal();
  report.T_base_tool0 = report.T_base_tool * settings_.T_tool0_tool.inverse();
  return report;
}

std::vector<std::uint8_t> RobotController::packet(std::int64_t instant,
                                                  std::int64_t clock_back_us) {
  const RobotReport place = report(instant, clock_back_us);
  HspoReport packet;
  packet.index = place.number;
  const double ticks = static_cast<double>(place.clock_ns) / (1000 * settings_.tick_us);
  packet.clock = static_cast<std::uint32_t>(std::llround(std::floor(ticks)));
  if (settings_.joints_too) {
    const Joints counted = fanuc_count(place.joints);
    packet.joints.emplace();
    for (std::size_t i = 0; i < counted.size(); ++i)
      (*packet.joints)[i] = static_cast<float>(counted[i]);
  }
  const XyzWpr f = to_xyzwpr(place.T_base_tool);
  packet.tool = {static_cast<float>(f.x), static_cast<float>(f.y), static_cast<float>(f.z),
                 static_cast<float>(f.w), static_cast<float>(f.p), static_cast<float>(f.r)};
  return hspo_packet(packet);
}

}  // namespace arcstart::cell_simulator
