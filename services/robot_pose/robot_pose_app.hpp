// Positions of the robot on the bus: one ROBOT0_POSE for each the controller reports.
#pragma once

#include <arcstart/clock_probe_t.hpp>
#include <arcstart/scan_t.hpp>
#include <memory>

#include "common/clock_mapping.hpp"
#include "common/service.hpp"
#include "services/robot_pose/pose_source.hpp"
#include "services/robot_pose/robot_pose_settings.hpp"

namespace arcstart::robot_pose {

class RobotPoseApp : public App {
 public:
  // The bus outlives the app. Starts the source; throws what its start() throws.
  RobotPoseApp(Bus& bus, const RobotPoseSettings& settings, const Instance& instance,
               std::int64_t run_id, std::unique_ptr<PoseSource> source);

  void tick(std::int64_t now_utime) override;
  Health health() const override { return health_; }

 private:
  void answer(clock_probe_t question, const std::string& robot);
  void publish(const ReportedPosition& reported);
  void note_errors(std::int64_t now);
  void judge(std::int64_t now);

  Bus& bus_;
  RobotPoseSettings settings_;
  std::string channel_;
  std::int64_t run_id_;
  std::unique_ptr<PoseSource> source_;
  ClockMapping clock_;
  std::int64_t last_utime_ = 0;  // published

  bool scanning_ = false;
  std::int64_t scan_heard_ = 0;  // steady; us

  std::int64_t position_heard_;  // steady; us
  std::int64_t valid_heard_;     // likewise, a valid one
  bool valid_once_ = false;
  std::string invalid_;  // why the newest position is, empty for a valid one

  Health health_;
  std::string error_;            // told for a while
  std::int64_t error_told_ = 0;  // steady; us
  std::int64_t troubles_ = 0;    // malformed, foreign and late packets at that time
};

// The whole main of arcstart-robot-pose.
int run(int argc, char** argv);

}  // namespace arcstart::robot_pose
