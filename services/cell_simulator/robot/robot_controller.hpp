// What the simulated controller reports: the arm's place at an instant.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "services/cell_simulator/base/device_clock.hpp"
#include "services/cell_simulator/robot/fanuc_m20ia.hpp"

namespace arcstart::cell_simulator {

struct RobotControllerSettings {
  RigidTransform T_tool0_tool = RigidTransform::Identity();
  double position_noise = 0.02;  // standard deviation on x, y and z each; mm
  bool joints_too = true;        // beside the tool centre point, in the same packet
  double tick_us = 1;            // of the controller's clock
  DeviceClock clock;
  std::uint64_t seed = 1;  // of the noise
};

// What the arm's controller knows at an instant, whatever the protocol that tells it.
struct RobotReport {
  std::uint32_t number = 0;     // counts the reports from 0, wraps
  std::int64_t clock_ns = 0;    // the controller's own clock
  RigidTransform T_base_tool;   // as measured: with noise
  RigidTransform T_base_tool0;  // the flange, likewise
  Joints joints{};              // the model's; rad, zeros where joints_too is false
};

// Called from one thread, but for unreachable().
class RobotController {
 public:
  using Pose = std::function<RigidTransform(std::int64_t utime)>;  // T_base_tool

  RobotController(const RobotControllerSettings& settings, Pose pose);

  // Of an instant (us, UTC). clock_back_us is taken off the controller's clock.
  RobotReport report(std::int64_t instant, std::int64_t clock_back_us = 0);

  // The report as HSPO's packet; the first has index 0.
  std::vector<std::uint8_t> packet(std::int64_t instant, std::int64_t clock_back_us = 0);

  std::int64_t unreachable() const {
    return unreachable_;
  }  // poses without joints, which kept the last ones

 private:
  RobotControllerSettings settings_;
  Pose pose_;
  FanucM20ia arm_;
  std::optional<Joints> joints_;  // of the last packet
  std::uint64_t packets_ = 0;
  std::atomic<std::int64_t> unreachable_{0};
};

}  // namespace arcstart::cell_simulator
