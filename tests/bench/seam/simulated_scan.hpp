// Scans of the simulated cell without devices and without waiting: rendered images, positions,
// calibration and scan states, put on a memq bus in order of time as sensor_capture, robot_pose and
// calibration would.
#pragma once

#include <arcstart/truth_t.hpp>
#include <cstdint>
#include <optional>
#include <random>

#include "common/bus/bus.hpp"
#include "common/calibration.hpp"
#include "services/cell_simulator/image/image_renderer.hpp"
#include "services/cell_simulator/scene/scene.hpp"
#include "services/cell_simulator/wild/wild_build.hpp"

namespace arcstart {

struct SimulatedScanSettings {
  cell_simulator::SceneSettings scene;
  cell_simulator::SensorSettings sensor;
  double speed_mm_s = 50;
  double frames_per_second = 14;
  double positions_per_second = 50;
  double position_noise_mm = 0.02;
  double image_delay_s = 0.02732;  // images are stamped so much late
  double frames_lost_share = 0;    // at the camera
  double positions_lost_share = 0;
  std::optional<Calibration> calibration;  // what the pipeline is told; nothing: the truth
  // A scene of the wild in place of `scene`: then the search, the frames per second and the
  // sensor's lean are its own, and what is told of calibration and positions errs as it says.
  std::optional<cell_simulator::WildScene> wild;
  // What the robot says is wrong by these, the same all through a scan, drawn anew for each:
  // standard deviations an axis, of the place in base and of the turn about the tool centre point.
  double robot_error_mm = 0, robot_error_deg = 0;
};

class SimulatedScan {
 public:
  // The bus must outlive this. The seed makes the scene, the trigger's phase and all noise.
  SimulatedScan(Bus& bus, const SimulatedScanSettings& settings, std::uint64_t seed);

  // Where there is no seam, a truth without a joint type; of several seams the first.
  truth_t truth() const;

  // One whole scan from its start command to its end; what the pipeline says is handled on the way.
  void run(cell_simulator::SceneKind kind);

  // Of the scans to come.
  void set_losses(double frames_share, double positions_share) {
    settings_.frames_lost_share = frames_share;
    settings_.positions_lost_share = positions_share;
  }

 private:
  void publish_calibration();
  void draw_robot_error(cell_simulator::SceneKind kind);
  void publish_scan(std::int8_t state, cell_simulator::SceneKind kind, std::int64_t now,
                    int images);
  void publish_pose(const RigidTransform& T_base_tool, std::int64_t utime);
  void publish_image(const cell_simulator::Scene& scene, const RigidTransform& T_base_tool,
                     std::int64_t middle, int index);

  cell_simulator::Scene make_scene(cell_simulator::SceneKind kind) const;
  // Speckle and noise; of a scene of the wild also what shakes, flickers and hangs on the tool.
  void render(const cell_simulator::Scene& scene, const RigidTransform& T_base_tool,
              std::uint64_t frame_seed, std::vector<std::uint8_t>& grey);

  bool lost(double share) { return std::uniform_real_distribution<double>(0, 1)(losses_) < share; }

  Bus& bus_;
  SimulatedScanSettings settings_;
  std::mt19937_64 losses_;
  std::uint64_t seed_;
  cell_simulator::ImageRenderer renderer_;
  std::optional<cell_simulator::Scene> on_tool_;  // in camera
  std::int64_t clock_ = 1'700'000'000'000'000;    // us, UTC
  std::int64_t scan_id_ = 0, image_seq_ = 0, pose_seq_ = 0, first_seq_ = 0, last_seq_ = 0;
  int frames_lost_ = 0;                                      // of this scan
  int gap_ = 0;                                              // frames lost since the last that came
  RigidTransform robot_error_ = RigidTransform::Identity();  // of this scan
};

}  // namespace arcstart
