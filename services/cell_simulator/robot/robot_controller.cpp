#include "services/cell_simulator/robot/robot_controller.hpp"

#include <cmath>

#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/robot/hspo_packet.hpp"

namespace arcstart::cell_simulator {
RobotController::RobotController(const RobotControllerSettings& settings, Pose pose)
    : settings_(settings), pose_(std::move(pose)), arm_(settings.T_tool0_tool) {}

std::vector<std::uint8_t> RobotController::packet(std::int64_t instant,
                                                  std::int64_t clock_back_us) {
  RigidTransform T_base_tool = pose_(instant);
  HspoReport report;
  report.index = static_cast<std::uint32_t>(packets_);
  const double ticks = static_cast<double>(settings_.clock.nanoseconds(instant - clock_back_us)) /
                       (1000 * settings_.tick_us);
  report.clock = static_cast<std::uint32_t>(std::llround(std::floor(ticks)));

  if (settings_.joints_too) {
    const auto near = joints_ ? arm_.joints(T_base_tool, *joints_) : std::nullopt;
    if (const auto joints = near ? near : arm_.joints(T_base_tool))
      joints_ = joints;
    else
      ++unreachable_;
    const Joints counted = fanuc_count(joints_.value_or(Joints{}));
    report.joints.emplace();
    for (std::size_t i = 0; i < counted.size(); ++i)
      (*report.joints)[i] = static_cast<float>(counted[i]);
  }

  RandomStream noise(settings_.seed, packets_++);
  for (int axis = 0; axis < 3; ++axis)
    T_base_tool.translation()(axis) += settings_.position_noise * noise.normal();
  const XyzWpr f = to_xyzwpr(T_base_tool);
  report.tool = {static_cast<float>(f.x), static_cast<float>(f.y), static_cast<float>(f.z),
                 static_cast<float>(f.w), static_cast<float>(f.p), static_cast<float>(f.r)};
  return hspo_packet(report);
}

}  // namespace arcstart::cell_simulator
