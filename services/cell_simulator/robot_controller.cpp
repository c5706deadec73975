#include "services/cell_simulator/robot_controller.hpp"

#include "services/cell_simulator/hspo_packet.hpp"
#include "services/cell_simulator/random_stream.hpp"

namespace arcstart {
namespace {

constexpr Joints kHome = {0, 0, 0, 0, -1.5707963267948966, 0};

}  // namespace

RobotController::RobotController(const RobotControllerSettings& settings, Pose pose)
    : settings_(settings), pose_(std::move(pose)), arm_(settings.T_tool0_tool), joints_(kHome) {}

std::vector<std::uint8_t> RobotController::packet(std::int64_t instant,
                                                  std::int64_t clock_back_us) {
  RigidTransform T_base_tool = pose_(instant);
  HspoReport report;
  report.index = static_cast<std::uint32_t>(packets_);
  const double ticks = static_cast<double>(settings_.clock.nanoseconds(instant - clock_back_us)) /
                       (1000 * settings_.tick_us);
  report.clock = static_cast<std::uint32_t>(static_cast<std::uint64_t>(ticks));

  if (settings_.joints_too) {
    auto joints = arm_.joints(T_base_tool, joints_);
    if (!joints) joints = arm_.joints(T_base_tool);
    if (joints)
      joints_ = *joints;
    else
      ++unreachable_;
    const Joints counted = fanuc_count(joints_);
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

}  // namespace arcstart
