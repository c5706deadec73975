#include "tests/bench/seam/simulated_scan.hpp"

#include <random>

#include "common/bus/calibration_message.hpp"
#include "common/bus/crc32c.hpp"
#include "common/sensor_model.hpp"
#include "common/time.hpp"
#include "services/cell_simulator/base/random_stream.hpp"
#include "tests/seam_finding/support/wild_told.hpp"

namespace arcstart {

using namespace cell_simulator;
namespace {

constexpr std::int64_t kRunId = 1'699'999'999'000'000;

void copy(const Eigen::Vector3d& from, double to[3]) { std::copy(from.begin(), from.end(), to); }

// Those by which a scene of the wild is scanned.
SimulatedScanSettings completed(SimulatedScanSettings settings) {
  if (!settings.wild) return settings;
  settings.sensor = sensor_of(*settings.wild, settings.sensor);
  settings.scene = taught_scene_of(*settings.wild, settings.scene);
  settings.frames_per_second = settings.speed_mm_s / settings.wild->scan.pitch_mm;
  return settings;
}

}  // namespace

SimulatedScan::SimulatedScan(Bus& bus, const SimulatedScanSettings& settings, std::uint64_t seed)
    : bus_(bus),
      settings_(completed(settings)),
      losses_(seed * 31 + 7),
      seed_(seed),
      renderer_(settings_.sensor) {
  if (settings_.wild) on_tool_ = on_tool(*settings_.wild);
  publish_calibration();
}

void SimulatedScan::publish_calibration() {
  if (settings_.calibration)
    return bus_.publish("LASER0_CALIBRATION", to_message(*settings_.calibration));
  cell_simulator::TrueSensor sensor = renderer_.sensor();
  if (settings_.wild) sensor = seam_finding::synthetic::told_sensor(*settings_.wild, sensor);
  SensorModel model{
      sensor.width, sensor.height, sensor.fx,         sensor.fy,
      sensor.cx,    sensor.cy,     sensor.distortion, {sensor.laser_normal, sensor.laser_offset}};
  calibration_t message{};
  message.utime = kRunId;
  message.id = "simulated";
  message.sensor = "LASER0";
  message.robot = "ROBOT0";
  message.tool = "TCP1";
  message.width = sensor.width;
  message.height = sensor.height;
  const double camera[] = {sensor.fx, sensor.fy, sensor.cx, sensor.cy};
  std::copy(std::begin(camera), std::end(camera), message.camera_matrix);
  std::copy(sensor.distortion.begin(), sensor.distortion.end(), message.distortion);
  copy(sensor.laser_normal, message.laser_plane);
  message.laser_plane[3] = sensor.laser_offset;
  const Eigen::Matrix<double, 4, 3> M = pixel_to_camera(model);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 3; ++column)
      message.pixel_to_camera[row][column] = M(row, column);
  transform_to_arrays(sensor.T_tool_camera, message.camera_position, message.camera_quaternion);
  message.time_offset = -settings_.image_delay_s;
  message.camera_residual = message.laser_plane_residual = message.hand_eye_residual = -1;
  message.camera_limit = message.laser_plane_limit = message.leave_one_out_limit =
      message.predicted_limit = message.robot_position_limit = message.robot_orientation_limit = -1;
  message.poses = -1;
  message.origin = "simulator's truth";
  bus_.publish("LASER0_CALIBRATION", message);
}

void SimulatedScan::draw_robot_error(cell_simulator::SceneKind kind) {
  cell_simulator::RandomStream random(seed_,
                                      kind == cell_simulator::SceneKind::workpiece ? 82 : 81);
  Eigen::Vector3d shift, turn;
  for (double& value : shift) value = settings_.robot_error_mm * random.normal();
  for (double& value : turn) value = settings_.robot_error_deg * EIGEN_PI / 180 * random.normal();
  robot_error_ = RigidTransform::Identity();
  robot_error_.translation() = shift;
  if (turn.norm() > 0)
    robot_error_.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
}

void SimulatedScan::publish_scan(std::int8_t state, cell_simulator::SceneKind kind,
                                 std::int64_t now, int images) {
  scan_t message{};
  message.utime = now;
  message.run_id = kRunId;
  message.state = state;
  message.scan_id = message.begin_utime = message.command_id = scan_id_;
  message.kind =
      kind == cell_simulator::SceneKind::background ? scan_t::BACKGROUND : scan_t::WORKPIECE;
  message.end_utime = state == scan_t::ENDED ? now : 0;
  message.first_seq = images > 0 ? first_seq_ : -1;
  message.last_seq = images > 0 ? last_seq_ : -1;
  message.images = images;
  message.lost = frames_lost_;
  message.start_command_id = scan_id_;
  message.previous_first_seq = message.previous_last_seq = -1;
  if (state == scan_t::ENDED) {
    message.end_cause = scan_t::STANDSTILL;
    message.end_reason = "tool stood still";
  }
  bus_.publish("LASER0_SCAN", message);
}

void SimulatedScan::publish_pose(const RigidTransform& T_base_tool, std::int64_t utime) {
  std::mt19937_64 random(seed_ * 1'000'003 + static_cast<std::uint64_t>(pose_seq_));
  std::normal_distribution<double> noise(0, settings_.position_noise_mm);
  robot_pose_t message{};
  message.utime = message.arrival_utime = utime;
  message.run_id = kRunId;
  message.seq = pose_seq_++;
  RigidTransform seen = T_base_tool;
  if (settings_.wild) seen = seam_finding::synthetic::told_pose(*settings_.wild, T_base_tool);
  seen.linear() = robot_error_.linear() * seen.linear();
  seen.translation() += robot_error_.translation();
  seen.translation() += Eigen::Vector3d(noise(random), noise(random), noise(random));
  transform_to_arrays(seen, message.position, message.quaternion);
  message.tool_frame = message.user_frame = -1;
  message.device_clock = utime;
  message.device_tick_us = 1;
  if (!lost(settings_.positions_lost_share)) bus_.publish("ROBOT0_POSE", message);
}

void SimulatedScan::publish_image(const cell_simulator::Scene& scene,
                                  const RigidTransform& T_base_tool, std::int64_t middle,
                                  int index) {
  const cell_simulator::TrueSensor& sensor = renderer_.sensor();
  if (lost(settings_.frames_lost_share)) {
    ++image_seq_;
    ++gap_;
    return;
  }
  // A frame is missed when the next one comes.
  frames_lost_ += gap_;
  gap_ = 0;
  last_seq_ = image_seq_;
  image_t message{};
  message.utime = middle + seconds_to_us(settings_.image_delay_s);
  message.run_id = kRunId;
  message.seq = image_seq_++;
  message.scan_id = scan_id_;
  message.scan_index = index;
  message.width = message.sensor_width = static_cast<std::int16_t>(sensor.width);
  message.height = message.sensor_height = static_cast<std::int16_t>(sensor.height);
  message.exposure_us = cell_simulator::Exposure{}.exposure_us;
  message.laser_on = true;
  message.arrival_utime = message.utime;
  message.size = sensor.width * sensor.height;
  message.data.resize(static_cast<std::size_t>(message.size));
  render(scene, T_base_tool, seed_ * 100'003 + static_cast<std::uint64_t>(message.seq),
         message.data);
  message.crc32c = crc32c(message.data);
  bus_.publish("LASER0_IMAGE", message);
}

cell_simulator::Scene SimulatedScan::make_scene(cell_simulator::SceneKind kind) const {
  return settings_.wild ? build(*settings_.wild, kind)
                        : cell_simulator::make_scene(settings_.scene, kind, seed_);
}

void SimulatedScan::render(const Scene& scene, const RigidTransform& T_base_tool,
                           std::uint64_t frame_seed, std::vector<std::uint8_t>& grey) {
  const auto render_it = [&](const Scene& shown) {
    renderer_.render(shown, T_base_tool, Exposure{}, frame_seed, grey.data(),
                     renderer_.whole_image());
  };
  const WildEvents events = settings_.wild ? settings_.wild->events : WildEvents{};
  RandomStream random(frame_seed, 83);
  const double flicker = events.flicker_grey * random.uniform();
  if (on_tool_ || events.shake_mm > 0) {
    Eigen::Vector3d shaken;
    for (double& value : shaken) value = events.shake_mm * random.normal();
    render_it(in_frame(scene, on_tool_ ? &*on_tool_ : nullptr,
                       T_base_tool * renderer_.sensor().T_tool_camera, shaken));
  } else {
    render_it(scene);
  }
  const int brighter = static_cast<int>(flicker);
  if (brighter > 0)
    for (std::uint8_t& value : grey)
      value = static_cast<std::uint8_t>(std::min(255, value + brighter));
}

void SimulatedScan::run(cell_simulator::SceneKind kind) {
  const cell_simulator::Scene scene = make_scene(kind);
  const RigidTransform begin = cell_simulator::taught_tool_pose(settings_.sensor, settings_.scene,
                                                                settings_.scene.search_begin_mm);
  const RigidTransform end = cell_simulator::taught_tool_pose(settings_.sensor, settings_.scene,
                                                              settings_.scene.search_end_mm);
  const double duration =
      (end.translation() - begin.translation()).norm() / settings_.speed_mm_s;  // s
  // Half a second of rest on either side of the search; the trigger's phase by seed and scan.
  std::mt19937_64 random(seed_ * 2 + (kind == cell_simulator::SceneKind::workpiece));
  double phase = std::uniform_real_distribution<double>(0, 1 / settings_.frames_per_second)(random);
  if (settings_.wild && kind == cell_simulator::SceneKind::workpiece) {
    // Its stripes fall where those of the scan in closed form do; the motion begins after 0.5 s.
    const double frames = settings_.wild->scan.phase_share + 0.5 * settings_.frames_per_second;
    phase = (frames - std::floor(frames)) / settings_.frames_per_second;
  }
  scan_id_ = clock_ += 10'000'000;
  const auto pose_at = [&](double seconds) {
    return interpolate(begin, end, std::clamp((seconds - 0.5) / duration, 0.0, 1.0));
  };
  publish_scan(scan_t::SCANNING, kind, clock_, 0);
  first_seq_ = image_seq_;
  frames_lost_ = gap_ = 0;
  draw_robot_error(kind);
  int images = 0, positions = -50;  // a second of positions before the scan
  const double last = duration + 1;
  for (;;) {
    const double image_time = phase + images / settings_.frames_per_second;
    const double position_time = positions / settings_.positions_per_second;
    if (image_time > last && position_time > last + 0.1) break;
    if (position_time <= image_time || image_time > last) {
      publish_pose(pose_at(position_time), scan_id_ + seconds_to_us(position_time));
      ++positions;
    } else {
      publish_image(scene, pose_at(image_time), scan_id_ + seconds_to_us(image_time), images);
      ++images;
    }
    while (bus_.handle(std::chrono::milliseconds(0))) {
    }
  }
  clock_ = scan_id_ + seconds_to_us(last + 0.1);
  publish_scan(scan_t::ENDED, kind, clock_, images);
  while (bus_.handle(std::chrono::milliseconds(0))) {
  }
}

truth_t SimulatedScan::truth() const {
  truth_t message{};
  message.utime = kRunId;
  message.seed = static_cast<std::int64_t>(seed_);
  const auto found = make_scene(cell_simulator::SceneKind::workpiece).seam();
  if (!found) return message;
  const cell_simulator::SeamTruth& seam = *found;
  message.joint_type = seam.joint_type;
  copy(seam.start, message.start);
  copy(seam.end, message.end);
  copy(seam.direction, message.direction);
  copy(seam.normals[0], message.normals[0]);
  copy(seam.normals[1], message.normals[1]);
  message.angle = seam.angle;
  return message;
}

}  // namespace arcstart
