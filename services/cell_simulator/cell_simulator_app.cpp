#include "services/cell_simulator/cell_simulator_app.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "common/time.hpp"
#include "services/cell_simulator/calibration_writer.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::int64_t kScanSilent =
    2'000'000;  // LASER0_SCAN comes at 5 Hz; after so long its scan is over; us
constexpr std::int64_t kTruthPeriod = 1'000'000;  // us
constexpr std::size_t kCommandsKnown = 1000;
constexpr const char* kTruth = "CELL_TRUTH";
constexpr const char* kCommand = "CELL_COMMAND";

template <class Vector>
void copy(const Vector& from, double (&to)[3]) {
  std::copy(from.data(), from.data() + 3, to);
}

}  // namespace

CellSimulatorApp::CellSimulatorApp(Bus& bus, const CellSimulatorSettings& settings,
                                   const Instance& instance, std::int64_t now)
    : bus_(bus), cell_(settings, now) {
  if (!settings.calibration_file.empty()) {
    const TrueCalibration calibration{instance.sensor, instance.robot, settings.tool,
                                      cell_.sensor(), -settings.image_delay_ms * 1e-3};
    if (write_calibration(settings.calibration_file, calibration, now))
      spdlog::info(fmt::format("{}: the true calibration written", settings.calibration_file));
  }
  bus_.subscribe<scan_t>(instance.sensor_channel("SCAN"), Queue::measurements(),
                         [this](const scan_t& scan) { on_scan(scan); });
  bus_.subscribe<cell_command_t>(kCommand, Queue::measurements(),
                                 [this](const cell_command_t& command) { on_command(command); });
}

void CellSimulatorApp::on_scan(const scan_t& scan) {
  const std::int64_t now = utime_now();
  scan_heard_ = now;
  const bool same = scan.run_id == scan_run_id_ && scan.scan_id == scan_id_;
  if (scanning_ && (!same || scan.state != scan_t::SCANNING)) end_scan(now, "it ended");
  if (same || scan.state != scan_t::SCANNING) return;
  scan_run_id_ = scan.run_id;
  scan_id_ = scan.scan_id;
  scanning_ = true;
  const std::int64_t start = cell_.scan_begins(now, scan.begin_utime);
  spdlog::info(fmt::format("scan {}: the search begins {:.3f} s after it", scan_id_,
                           static_cast<double>(start - scan.begin_utime) * 1e-6));
}

void CellSimulatorApp::end_scan(std::int64_t now, const char* why) {
  scanning_ = false;
  cell_.scan_ends(now);
  spdlog::info(fmt::format("scan {}: {}; the arm goes back", scan_id_, why));
}

void CellSimulatorApp::on_command(const cell_command_t& command) {
  if (known_commands_.size() > kCommandsKnown) known_commands_.clear();
  if (known_commands_.insert(command.command_id).second) waiting_.push_back(command);
}

void CellSimulatorApp::carry_out(const cell_command_t& command, std::int64_t now) {
  const RigidTransform pose = command.move
                                  ? transform_from_arrays(command.position, command.quaternion)
                                  : RigidTransform::Identity();
  refusal_.clear();
  try {
    if (command.move && !cell_.reaches(pose))
      throw std::runtime_error("the arm does not reach this pose");
    if (command.scene == cell_command_t::PLATE) {
      const auto seed = command.seed < 0 ? cell_.seed() : static_cast<std::uint64_t>(command.seed);
      if (!cell_.shows_plate() || seed != cell_.seed()) cell_.put_plate(seed);
      if (command.plate_pose > 0 && !cell_.go_to_plate_pose(now, command.plate_pose))
        throw std::runtime_error(
            fmt::format("no pose {} of the plate can be reached", command.plate_pose));
    } else if (command.scene != cell_command_t::KEEP || command.seed >= 0) {
      const SceneKind kind = command.scene == cell_command_t::KEEP         ? cell_.kind()
                             : command.scene == cell_command_t::BACKGROUND ? SceneKind::background
                                                                           : SceneKind::workpiece;
      cell_.put(kind, command.seed < 0 ? cell_.seed() : static_cast<std::uint64_t>(command.seed));
    }
    if (command.move) cell_.go_to(now, pose);
    if (command.scene == cell_command_t::WORKPIECE) cell_.press_cycle_start();
    command_id_ = command.command_id;
  } catch (const std::exception& error) {
    refusal_ = fmt::format("{} {} refused: {}", kCommand, command.command_id, error.what());
  }
}

void CellSimulatorApp::tick(std::int64_t now) {
  if (scanning_ && now - scan_heard_ > kScanSilent) end_scan(now, "nothing more is heard of it");
  // Not while the arm is on its way back either: who sees a command carried out may scan again.
  while (!scanning_ && cell_.at_rest(now) && !waiting_.empty()) {
    carry_out(waiting_.front(), now);
    waiting_.pop_front();
  }
  cell_.tick(now);
  tell_truth(now);
}

truth_t CellSimulatorApp::truth(std::int64_t now) const {
  truth_t truth{};
  truth.utime = now;
  truth.command_id = command_id_;
  truth.scene = cell_.shows_plate()                    ? cell_command_t::PLATE
                : cell_.kind() == SceneKind::workpiece ? cell_command_t::WORKPIECE
                                                       : cell_command_t::BACKGROUND;
  truth.seed = static_cast<std::int64_t>(cell_.seed());
  if (const auto& seam = cell_.seam(); seam && !cell_.shows_plate()) {
    truth.joint_type = seam->joint_type;
    copy(seam->start, truth.start);
    copy(seam->end, truth.end);
    copy(seam->direction, truth.direction);
    copy(seam->normals[0], truth.normals[0]);
    copy(seam->normals[1], truth.normals[1]);
    truth.angle = seam->angle;
  }
  truth.frames = cell_.frames();
  truth.positions = cell_.positions();
  truth.laser_on = cell_.laser_on();
  truth.moving = cell_.moving(now);
  transform_to_arrays(cell_.tool_pose(now), truth.tool_position, truth.tool_quaternion);
  return truth;
}

void CellSimulatorApp::tell_truth(std::int64_t now) {
  const truth_t news = truth(now);
  const bool changed = news.command_id != told_.command_id || news.scene != told_.scene ||
                       news.seed != told_.seed || news.laser_on != told_.laser_on ||
                       news.moving != told_.moving;
  if (!changed && now - told_.utime < kTruthPeriod && now >= told_.utime) return;
  bus_.publish(kTruth, news);
  told_ = news;
}

Health CellSimulatorApp::health() const {
  Health health;
  health.last_error = refusal_.empty() ? cell_.fault() : refusal_;
  if (!cell_.fault().empty()) health.state = service_status_t::FAULT;
  return health;
}

}  // namespace arcstart::cell_simulator
