#include "services/robot_pose/robot_pose_app.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "common/time.hpp"

namespace arcstart::robot_pose {
namespace {

static_assert(static_cast<int>(RobotProtocol::kUnknown) == robot_pose_t::UNKNOWN &&
              static_cast<int>(RobotProtocol::kHspo) == robot_pose_t::HSPO &&
              static_cast<int>(RobotProtocol::kJ519) == robot_pose_t::J519 &&
              static_cast<int>(RobotProtocol::kRtde) == robot_pose_t::RTDE);

constexpr std::int64_t kScanStateHolds = 2'000'000;  // LASER0_SCAN comes at 5 Hz
constexpr std::int64_t kErrorIsTold = 10'000'000;
constexpr std::int64_t kHeldBack = 5'000;  // us that a better known clock may cost

}  // namespace

RobotPoseApp::RobotPoseApp(Bus& bus, const RobotPoseSettings& settings, const Instance& instance,
                           std::int64_t run_id, std::unique_ptr<PoseSource> source)
    : bus_(bus),
      settings_(settings),
      channel_(instance.robot_channel("POSE")),
      run_id_(run_id),
      source_(std::move(source)),
      position_heard_(steady_now()),
      valid_heard_(steady_now()) {
  bus_.subscribe<scan_t>(instance.sensor_channel("SCAN"), Queue::newest(), [this](const scan_t& m) {
    scanning_ = m.state == scan_t::SCANNING;
    scan_heard_ = steady_now();
  });
  bus_.subscribe<clock_probe_t>(
      "CLOCK_PROBE", Queue::measurements(),
      [this, robot = instance.robot](const clock_probe_t& m) { answer(m, robot); });
  source_->start();
}

// At once: what it takes widens the bound of the clocks' difference.
void RobotPoseApp::answer(clock_probe_t question, const std::string& robot) {
  if (question.answerer_run_id != 0 || question.robot != robot) return;
  question.heard_utime = utime_now();
  question.answerer_run_id = run_id_;
  question.answered_utime = utime_now();
  bus_.publish("CLOCK_PROBE", question);
}

void RobotPoseApp::tick(std::int64_t) {
  // A sensor_capture that died in a scan must not freeze the clock for ever.
  clock_.freeze(scanning_ && steady_now() - scan_heard_ < kScanStateHolds);
  while (const auto reported = source_->poll()) {
    position_heard_ = steady_now();
    publish(*reported);
    if (!invalid_.empty()) continue;
    valid_heard_ = position_heard_;
    valid_once_ = true;
  }
  note_errors(steady_now());
  judge(steady_now());
}

void RobotPoseApp::publish(const ReportedPosition& reported) {
  robot_pose_t pose{};
  pose.run_id = run_id_;
  pose.seq = reported.seq;
  Eigen::Map<Eigen::Vector3d>(pose.position) = reported.position;
  pose.quaternion[0] = reported.rotation.w();
  Eigen::Map<Eigen::Vector3d>(pose.quaternion + 1) = reported.rotation.vec();
  pose.source = static_cast<std::int8_t>(reported.source);
  pose.tool_frame = static_cast<std::int16_t>(reported.tool_frame);
  pose.user_frame = static_cast<std::int16_t>(reported.user_frame);
  pose.joint_count = static_cast<std::int8_t>(reported.joints.size());
  pose.joints = reported.joints;
  pose.device_clock = reported.device_clock;
  pose.device_tick_us = reported.device_tick_us;
  pose.arrival_utime = reported.arrival_utime;
  pose.invalid = reported.invalid;

  pose.utime = reported.arrival_utime;
  if (pose.invalid.empty()) {
    if (reported.clock_begins) clock_.restart();
    const double device_us = static_cast<double>(reported.device_clock) * reported.device_tick_us;
    pose.utime = clock_.map(static_cast<std::int64_t>(device_us), reported.arrival_utime);
    if (clock_.held_back_us() > kHeldBack)
      pose.invalid = fmt::format("the host's clock was set back, stamps stand still for {:.3f} s",
                                 static_cast<double>(clock_.held_back_us()) * 1e-6);
  }
  pose.utime = std::max(pose.utime, last_utime_ + 1);
  last_utime_ = pose.utime;
  invalid_ = pose.invalid;
  bus_.publish(channel_, pose);
}

// An error is told for a while after the last such packet, and its text changes once a second at
// most: a source that sends rubbish must not fill the log.
void RobotPoseApp::note_errors(std::int64_t now) {
  const PoseSourceCounts counts = source_->counts();
  const std::int64_t troubles = counts.malformed + counts.foreign + counts.late;
  if (!error_.empty() && now - error_told_ > kErrorIsTold) error_.clear();
  // The first positions are invalid until the controller's clock is known: no trouble yet.
  const bool starting = !valid_once_ && now - valid_heard_ < seconds_to_us(settings_.silence_s);
  if (troubles == troubles_ && (invalid_.empty() || starting)) return;
  if (!error_.empty() && now - error_told_ < 1'000'000) return;
  error_ = troubles != troubles_ ? source_->last_error() : "positions are invalid: " + invalid_;
  error_told_ = now;
  troubles_ = troubles;
}

void RobotPoseApp::judge(std::int64_t now) {
  const std::int64_t silence = seconds_to_us(settings_.silence_s);
  const PoseSourceCounts counts = source_->counts();
  health_ = Health{};
  health_.lost = counts.lost;
  health_.received = counts.received;
  health_.undecodable = counts.malformed + counts.foreign + counts.late;
  health_.last_error = error_;
  if (now - position_heard_ > silence) {
    health_.state = service_status_t::FAULT;
    health_.last_error =
        fmt::format("no position from the robot for {} s ({}): {}", settings_.silence_s,
                    source_->description(), source_->why_silent());
    if (!error_.empty()) health_.last_error += " Last trouble: " + error_;
  } else if (now - valid_heard_ > silence) {
    health_.state = service_status_t::FAULT;
  } else if (!valid_once_) {
    health_.state = service_status_t::STARTING;
  } else if (!error_.empty()) {
    health_.state = service_status_t::DEGRADED;
  }
}

}  // namespace arcstart::robot_pose
