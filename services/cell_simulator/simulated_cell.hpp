// The cell behind the network: scene, arm, camera and robot, put together from their settings.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "services/cell_simulator/camera/gige_camera.hpp"
#include "services/cell_simulator/cell_faults.hpp"
#include "services/cell_simulator/cell_simulator_settings.hpp"
#include "services/cell_simulator/controller/rmi_server.hpp"
#include "services/cell_simulator/controller/robot_program.hpp"
#include "services/cell_simulator/image/plate_view.hpp"
#include "services/cell_simulator/robot/hspo_sender.hpp"
#include "services/cell_simulator/robot/j519_server.hpp"
#include "services/cell_simulator/robot/robot_controller.hpp"
#include "services/cell_simulator/robot/rtde_server.hpp"
#include "services/cell_simulator/robot/search_motion.hpp"
#include "services/cell_simulator/wild/wild_build.hpp"

namespace arcstart::cell_simulator {

// Used by one thread; the devices' threads are its own. Times in us, UTC.
class SimulatedCell {
 public:
  // Throws SceneError, GigeCameraError, HspoSenderError, and std::runtime_error where the arm
  // cannot reach the taught positions or a protocol's port is taken.
  SimulatedCell(const CellSimulatorSettings& settings, std::int64_t now);
  ~SimulatedCell();

  // Returns when the search begins.
  std::int64_t scan_begins(std::int64_t now, std::int64_t scan_begin);
  void scan_ends(std::int64_t now);

  void put(SceneKind kind, std::uint64_t seed);  // throws SceneError and leaves the scene as it is
  void put_plate(std::uint64_t seed);            // the calibration plate in place of all else
  // To the n-th pose of those that a calibration wants; false where none can be reached. The robot
  // errs there by another amount than before.
  bool go_to_plate_pose(std::int64_t now, int number);
  bool shows_plate() const { return plate_ != nullptr; }
  bool reaches(const RigidTransform& T_base_tool);
  void go_to(std::int64_t now, const RigidTransform& T_base_tool) {
    motion_.go_to(now, T_base_tool);
  }
  void tick(std::int64_t now);  // at least ten times a second
  // The robot's own program asks for a scan of what now lies there, and moves to its answer; where
  // it is served by RMI.
  void press_cycle_start();

  SceneKind kind() const { return kind_; }
  std::uint64_t seed() const { return seed_; }
  const std::optional<SeamTruth>& seam() const { return scene_->seam(); }
  const TrueSensor& sensor() const { return renderer_.sensor(); }
  RigidTransform tool_pose(std::int64_t now) const { return motion_.pose(now); }
  bool moving(std::int64_t now) const { return motion_.moving(now); }
  bool at_rest(std::int64_t now) const {
    return motion_.at_rest_from(now) <= now;
  }  // and about to stay so
  bool laser_on() const { return camera_.laser_on(); }
  std::int64_t frames() const { return camera_.frames(); }
  std::int64_t positions() const { return sender_->sent(); }
  std::string fault() const {
    return fault_;
  }  // what cannot be done at present, with what to do; empty for nothing

 private:
  Scene make(SceneKind kind, std::uint64_t seed) const;
  void render(const SimulatedFrame& frame, std::uint8_t* grey);
  RigidTransform reported_pose(std::int64_t utime) const;
  void serve_protocols(std::int64_t now);
  void run_program(std::int64_t now);

  std::optional<WildScene> wild_;
  CellSimulatorSettings settings_;  // with what a scene of the wild brings along
  mutable std::mutex scene_mutex_;  // of what the devices' threads read: the six below
  SceneKind kind_;
  std::uint64_t seed_;
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<PlateView> plate_;  // none where the scene is shown
  std::int64_t search_start_ = 0;
  RigidTransform robot_error_ = RigidTransform::Identity();  // shift in base, turn about the tool
  std::string fault_;

  CellFaults faults_;
  SearchMotion motion_;
  FanucM20ia arm_;
  RobotController controller_;
  ImageRenderer renderer_;  // used by the camera's threads alone, one at a time
  GigeCamera camera_;
  std::unique_ptr<HspoSender> sender_;
  std::unique_ptr<RobotController> j519_controller_, rtde_controller_;
  std::unique_ptr<J519Server> j519_;
  std::unique_ptr<RtdeServer> rtde_;
  ControllerMemory memory_;
  std::unique_ptr<RmiServer> rmi_;
  std::optional<RobotProgram> program_;
  int part_ = 0;  // the workpieces that were put in
};

}  // namespace arcstart::cell_simulator
