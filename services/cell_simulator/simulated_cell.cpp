#include "services/cell_simulator/simulated_cell.hpp"

#include <cmath>
#include <fstream>
#include <iterator>

#include "common/time.hpp"
#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/wild/wild_json.hpp"

namespace arcstart::cell_simulator {
namespace {

enum Purpose : std::uint64_t {
  kTriggerPhase = 1,
  kFrameNoise,
  kPositionNoise,
  kRobotError
};  // of random streams

SceneKind kind_of(const std::string& name) {
  return name == "workpiece" ? SceneKind::workpiece : SceneKind::background;
}

std::uint64_t mixed(std::uint64_t seed, Purpose purpose, std::uint64_t count) {
  return RandomStream(RandomStream(seed, purpose).next(), count).next();
}

DeviceClock clock(std::int64_t now, double start_s, double drift_ppm) {
  return {now, std::llround(start_s * 1e9), drift_ppm};
}

RigidTransform tool_of(const CellSimulatorSettings& s) {
  return from_xyzwpr({s.tool_mm[0], s.tool_mm[1], s.tool_mm[2], s.tool_wpr_deg[0],
                      s.tool_wpr_deg[1], s.tool_wpr_deg[2]});
}

RigidTransform search_begin(const CellSimulatorSettings& s) {
  return taught_tool_pose(s.sensor, s.scene, s.scene.search_begin_mm);
}
RigidTransform search_end(const CellSimulatorSettings& s) {
  return taught_tool_pose(s.sensor, s.scene, s.scene.search_end_mm);
}

GigeCameraSettings camera_settings(const CellSimulatorSettings& s, std::int64_t now) {
  return {s.camera_interface,      s.camera_serial,
          s.sensor.image_width_px, s.sensor.image_height_px,
          s.frame_rate_hz,         s.image_delay_ms * 1e-3,
          s.transport_ms * 1e-3,   clock(now, s.camera_clock_start_s, s.camera_clock_drift_ppm)};
}

RobotControllerSettings controller_settings(const CellSimulatorSettings& s, std::int64_t now) {
  return {tool_of(s),
          s.position_noise_mm,
          s.hspo_joints,
          s.hspo_tick_us,
          clock(now, s.robot_clock_start_s, s.robot_clock_drift_ppm),
          mixed(static_cast<std::uint64_t>(s.seed), kPositionNoise, 0)};
}

std::optional<WildScene> wild_of(const CellSimulatorSettings& settings) {
  if (!settings.wild_file.empty()) {
    std::ifstream file(settings.wild_file);
    if (!file) throw SceneError("wild_file: cannot read " + settings.wild_file);
    return wild_scene_from_json({std::istreambuf_iterator<char>(file), {}});
  }
  if (settings.wild_seed == 0) return {};
  return draw_wild_scene(settings.scene.joint, static_cast<std::uint64_t>(settings.wild_seed));
}

CellSimulatorSettings with(CellSimulatorSettings settings, const std::optional<WildScene>& wild) {
  if (!wild) return settings;
  settings.sensor = sensor_of(*wild, settings.sensor);
  settings.scene = taught_scene_of(*wild, settings.scene);
  settings.search_speed_mm_s = wild->scan.pitch_mm * settings.frame_rate_hz;
  return settings;
}

}  // namespace

SimulatedCell::SimulatedCell(const CellSimulatorSettings& given, std::int64_t now)
    : wild_(wild_of(given)),
      settings_(with(given, wild_)),
      kind_(kind_of(settings_.scene_at_start)),
      seed_(static_cast<std::uint64_t>(settings_.seed)),
      scene_(std::make_shared<const Scene>(make(kind_, seed_))),
      faults_({settings_.fault_scan, settings_.fault_after_s, settings_.fault_lose_every,
               settings_.fault_camera_away_s, settings_.fault_robot_silent_s,
               settings_.fault_robot_clock_back_s}),
      motion_(
          search_begin(settings_), search_end(settings_),
          {settings_.search_speed_mm_s, settings_.return_speed_mm_s, settings_.acceleration_mm_s2,
           settings_.search_delay_s, settings_.further_sweeps_mm_s}),
      arm_(tool_of(settings_)),
      controller_(controller_settings(settings_, now),
                  [this](std::int64_t utime) { return reported_pose(utime); }),
      renderer_(settings_.sensor),
      camera_(
          camera_settings(settings_, now),
          [this](const SimulatedFrame& frame, std::uint8_t* grey) { render(frame, grey); },
          [this](const SimulatedFrame& frame) {
            return faults_.frame_lost(frame.slot, camera_.frame_period());
          }) {
  if (!reaches(search_begin(settings_)) || !reaches(search_end(settings_)))
    throw std::runtime_error(
        "the arm cannot reach the taught positions: set work_position_mm or tool_mm");
  camera_.open();
  sender_ = std::make_unique<HspoSender>(
      settings_.hspo_host, settings_.hspo_port, seconds_to_us(settings_.hspo_period_ms * 1e-3),
      [this](std::int64_t instant) {
        auto packet = controller_.packet(instant, faults_.robot_clock_back_us(instant));
        if (faults_.robot_silent(instant)) packet.clear();
        return packet;
      });
  serve_protocols(now);
}

// One arm, a controller a protocol: each with noise of its own.
void SimulatedCell::serve_protocols(std::int64_t now) {
  const auto controller = [&](std::uint64_t number) {
    RobotControllerSettings settings = controller_settings(settings_, now);
    settings.joints_too = true;
    settings.seed = mixed(seed_, kPositionNoise, number);
    return std::make_unique<RobotController>(
        settings, [this](std::int64_t utime) { return reported_pose(utime); });
  };
  const auto report = [this](RobotController& of) {
    return [this, &of](std::int64_t instant) -> std::optional<RobotReport> {
      if (faults_.robot_silent(instant)) return std::nullopt;
      return of.report(instant, faults_.robot_clock_back_us(instant));
    };
  };
  const DeviceClock own =
      clock(now, settings_.robot_clock_start_s, settings_.robot_clock_drift_ppm);
  if (settings_.j519_port > 0) {
    j519_controller_ = controller(1);
    j519_ = std::make_unique<J519Server>(
        J519ServerSettings{"127.0.0.1", settings_.j519_port, settings_.j519_version,
                           settings_.j519_tool, own},
        report(*j519_controller_));
  }
  if (settings_.rtde_port > 0) {
    rtde_controller_ = controller(2);
    rtde_ = std::make_unique<RtdeServer>(
        RtdeServerSettings{"127.0.0.1", settings_.rtde_port, tool_of(settings_), own},
        report(*rtde_controller_));
  }
  if (settings_.rmi_port > 0) {
    const auto& f = settings_.rmi_frame;
    memory_.frames[1] = {f[0], f[1], f[2], f[3], f[4], f[5]};
    memory_.tools[1] = to_xyzwpr(tool_of(settings_));
    memory_.tools[1].z += settings_.rmi_tool_off_mm;
    RmiServerSettings server;
    server.port = settings_.rmi_port;
    server.request_ms = settings_.rmi_request_ms;
    rmi_ =
        std::make_unique<RmiServer>(server, memory_, [this] { return reported_pose(utime_now()); });
    program_.emplace(RobotProgramSettings{}, memory_);
  }
}

void SimulatedCell::press_cycle_start() {
  if (program_) program_->start(++part_);
}

void SimulatedCell::run_program(std::int64_t now) {
  const auto T_base_tool0 = program_->tick(now, at_rest(now));
  if (!T_base_tool0) return;
  const RigidTransform T_base_tool = *T_base_tool0 * tool_of(settings_);
  if (reaches(T_base_tool))
    motion_.go_to(now, T_base_tool);
  else
    fault_ = "the arm does not reach the position that its program was given";
}

SimulatedCell::~SimulatedCell() {
  rmi_.reset();
  rtde_.reset();
  j519_.reset();
  sender_.reset();
  camera_.close();
}

// The same search of the same scene gives the same frames: the trigger's phase follows from the
// seed and the kind of scene, and so do speckle and noise of the n-th frame after the search's
// begin.
std::int64_t SimulatedCell::scan_begins(std::int64_t now, std::int64_t scan_begin) {
  const double phase =
      RandomStream(mixed(seed_, kTriggerPhase, static_cast<std::uint64_t>(kind_))).uniform();
  faults_.scan_begins(scan_begin);
  const std::int64_t start = motion_.search(now, scan_begin, camera_.frame_period(), phase);
  const std::lock_guard lock(scene_mutex_);
  return search_start_ = start;
}

void SimulatedCell::scan_ends(std::int64_t now) {
  faults_.scan_ends(now);
  motion_.go_back(now);
}

Scene SimulatedCell::make(SceneKind kind, std::uint64_t seed) const {
  return wild_ ? build(*wild_, kind) : make_scene(settings_.scene, kind, seed);
}

void SimulatedCell::put(SceneKind kind, std::uint64_t seed) {
  auto scene = std::make_shared<const Scene>(make(kind, seed));
  {
    const std::lock_guard lock(scene_mutex_);
    kind_ = kind;
    seed_ = seed;
    scene_ = std::move(scene);
    plate_.reset();
  }
  camera_.scene_changed();
}

void SimulatedCell::put_plate(std::uint64_t seed) {
  auto plate = std::make_shared<PlateView>(settings_.sensor, settings_.scene, seed);
  {
    const std::lock_guard lock(scene_mutex_);
    seed_ = seed;
    plate_ = std::move(plate);
  }
  camera_.scene_changed();
}

bool SimulatedCell::go_to_plate_pose(std::int64_t now, int number) {
  const auto pose = plate_->pose(number, [this](const auto& T) { return reaches(T); });
  if (!pose) return false;
  RandomStream random(mixed(seed_, kRobotError, static_cast<std::uint64_t>(number)));
  const auto normal = [&] {
    return Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  };
  RigidTransform error = RigidTransform::Identity();
  error.translation() = settings_.robot_error_mm * normal();
  const Eigen::Vector3d turn = settings_.robot_error_deg * EIGEN_PI / 180 * normal();
  if (turn.norm() > 0)
    error.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  {
    const std::lock_guard lock(scene_mutex_);
    robot_error_ = error;
  }
  motion_.go_to(now, *pose);
  return true;
}

// What the controller believes, which its repeatability keeps from being true.
RigidTransform SimulatedCell::reported_pose(std::int64_t utime) const {
  RigidTransform pose = motion_.pose(utime);
  const std::lock_guard lock(scene_mutex_);
  pose.translation() += robot_error_.translation();
  pose.linear() = robot_error_.linear() * pose.linear();
  return pose;
}

bool SimulatedCell::reaches(const RigidTransform& T_base_tool) {
  return arm_.joints(T_base_tool).has_value();
}

void SimulatedCell::tick(std::int64_t now) {
  if (faults_.camera_away(now)) return camera_.close();
  try {
    camera_.open();
    fault_.clear();
  } catch (const std::exception& error) {
    fault_ = error.what();
  }
  camera_.tick(now);
  if (program_) run_program(now);
  if (fault_.empty() && controller_.unreachable() > 0)
    fault_ = "the arm could not follow a pose asked for: its joints stayed behind";
}

// On the camera's threads.
void SimulatedCell::render(const SimulatedFrame& frame, std::uint8_t* grey) {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<PlateView> plate;
  std::uint64_t noise_seed;
  {
    const std::lock_guard lock(scene_mutex_);
    scene = scene_;
    plate = plate_;
    noise_seed = mixed(seed_, kFrameNoise, static_cast<std::uint64_t>(kind_));
    const double period = static_cast<double>(camera_.frame_period());
    noise_seed = mixed(noise_seed, kFrameNoise,
                       static_cast<std::uint64_t>(std::llround(
                           static_cast<double>(frame.start - search_start_) / period)));
  }
  if (plate)
    return plate->render(motion_.pose(frame.middle()), motion_.moving(frame.middle()),
                         frame.exposure, frame.region, grey);
  renderer_.render(*scene, motion_.pose(frame.middle()), frame.exposure, noise_seed, grey,
                   frame.region);
}

}  // namespace arcstart::cell_simulator
