#include "services/sensor_capture/sensor_capture_app.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "services/sensor_capture/capture_messages.hpp"

namespace arcstart::sensor_capture {
namespace {

constexpr std::int64_t kPreviewPeriod = 500'000;
constexpr std::int64_t kScanStatePeriod = 200'000;
constexpr std::int64_t kErrorIsTold = 10'000'000;
constexpr std::int64_t kHeldBack = 5'000;  // us that a better known clock may cost
// us without a repetition, after which the laser goes dark: five of those that the calibration
// sends.
constexpr std::int64_t kCommandHolds = 1'000'000;
// Of a scan on its images' channel: of three one comes through, where one in a hundred is lost, in
// all but a millionth of the scans.
constexpr int kEnds = 3;

ScanOwnerSettings owner_settings(const SensorCaptureSettings& settings) {
  return {settings.longest_scan_s,
          settings.end_when_still,
          {settings.still_duration_s, settings.still_distance_mm, settings.still_angle_deg}};
}

}  // namespace

SensorCaptureApp::SensorCaptureApp(Bus& bus, const SensorCaptureSettings& settings,
                                   const Instance& instance, std::int64_t run_id,
                                   std::unique_ptr<FrameSource> source)
    : bus_(bus),
      settings_(settings),
      instance_(instance),
      run_id_(run_id),
      source_(std::move(source)),
      probes_(bus, instance.robot, run_id),
      timeline_(static_cast<std::int64_t>(settings.settle_margin_ms * 1000),
                settings.frames_to_settle),
      owner_(owner_settings(settings)) {
  bus_.subscribe<scan_command_t>(instance.sensor_channel("SCAN_COMMAND"), Queue::measurements(),
                                 [this](const scan_command_t& m) { take_scan_command(m); });
  bus_.subscribe<camera_command_t>(instance.sensor_channel("CAMERA_COMMAND"), Queue::measurements(),
                                   [this](const camera_command_t& m) { take_camera_command(m); });
  if (settings_.end_when_still)
    bus_.subscribe<robot_pose_t>(
        instance.robot_channel("POSE"), Queue::measurements(), [this](const robot_pose_t& m) {
          if (!m.invalid.empty()) return;
          const RigidTransform pose = transform_from_arrays(m.position, m.quaternion);
          owner_.position(m.utime, pose.translation(), Eigen::Quaterniond(pose.linear()));
        });
  source_->start();
}

SensorCaptureApp::~SensorCaptureApp() { source_->stop(); }

void SensorCaptureApp::tick(std::int64_t now) {
  follow_scan(now);  // what the commands and positions just handled have changed
  while (auto event = source_->poll())
    std::visit([&](auto& happened) { take(happened, now); }, *event);
  owner_.tick(now);
  if (command_ && now > command_->latest_utime) end_command("its images took too long");
  if (is_unattended()) end_command("it lit the laser and was not repeated for 1 s");
  follow_scan(now);
  if (steady_now() > error_until_) error_.clear();
  probes_.tick();
}

// The laser and the clock's mapping follow the scan; its state is told at once when it changes.
void SensorCaptureApp::follow_scan(std::int64_t now) {
  clock_.freeze(owner_.scanning());
  if (owner_.scanning()) ends_left_ = kEnds;
  if (owner_.scanning() && command_) end_command("a scan has begun");
  if (found_ && asked_ != wanted_settings()) ask_for(wanted_settings(), now);
  if (owner_.revision() != told_revision_ || steady_now() >= next_scan_state_) publish_scan(now);
}

void SensorCaptureApp::take(Frame& frame, std::int64_t now) {
  const std::int64_t device_us = frame.device_time_ns / 1000;
  const auto exposure_before = static_cast<std::int64_t>(timeline_.wanted().exposure_us);
  const std::int64_t begin = clock_.map(
      device_us, frame.arrival_utime - (settings_.leader_after_exposure ? exposure_before : 0));
  if (clock_.held_back_us() > kHeldBack && frame.incomplete.empty()) {
    frame.incomplete = "the host's clock was set back: when it was taken is not known";
    frame.pixels.clear();
  }
  SettingsTimeline::InForce in_force = timeline_.take_frame(begin);
  if (wired_laser_) in_force.lit = true;
  const bool complete = frame.incomplete.empty();
  const auto exposure = static_cast<std::int64_t>(in_force.settings.exposure_us);
  const Membership membership = owner_.frame(
      {frame.seq, begin, begin + exposure, in_force.lit && in_force.certain, complete});

  image_t image = make_image_message(frame, begin, in_force);
  image.run_id = run_id_;
  newest_image_ = image;
  if (complete && steady_now() >= next_preview_) {
    bus_.publish(instance_.sensor_channel("PREVIEW"), make_preview_message(image, frame));
    next_preview_ = steady_now() + kPreviewPeriod;
  }
  if (membership.scan_id != 0) {
    publish_image(image, frame, membership, 0);
  } else if (command_ && complete && in_force.certain && in_force.ticket >= command_->ticket) {
    publish_image(image, frame, membership, command_->command_id);
    if (--command_->left == 0) command_.reset();
  } else if (!owner_.scanning() && ends_left_ > 0) {
    publish_end(image);
  }
  follow_scan(now);
}

void SensorCaptureApp::take(const CameraFound& found, std::int64_t now) {
  spdlog::info(fmt::format("camera: {}", found.description));
  found_ = true;
  starting_ = false;
  camera_trouble_.clear();
  wired_laser_ = found.wired_laser;
  lit_ = found.settings.laser_on;
  clock_.restart();
  timeline_.begin(found.settings);
  owner_.set_shortest_period(found.shortest_period_us);
  owner_.set_longest_delay(1'000'000 + 3 * found.shortest_period_us);
  asked_.reset();  // what was asked before it was lost may still be on its way: ask again
  follow_scan(now);
}

void SensorCaptureApp::take(const CameraLost& lost, std::int64_t now) {
  found_ = false;
  starting_ = false;
  camera_trouble_ = lost.reason;
  if (command_) end_command(lost.reason);
  const bool ends_a_scan = owner_.scanning() && newest_image_.run_id != 0;
  owner_.camera_lost(now);
  if (ends_a_scan) {  // no frame comes by which to tell it
    ++newest_image_.seq;
    ++newest_image_.utime;
    while (ends_left_ > 0) publish_end(newest_image_);
  }
  follow_scan(now);
}

void SensorCaptureApp::take(const SettingsApplied& applied, std::int64_t now) {
  if (applied.error.empty()) {
    if (applied.ticket == last_ticket_) lit_ = applied.settings.laser_on;
    return timeline_.applied(applied.ticket, applied.settings, applied.acknowledged_utime);
  }
  timeline_.refused(applied.ticket);
  if (command_ && command_->ticket == applied.ticket) end_command(applied.error);
  error_ = applied.error;
  error_until_ = steady_now() + kErrorIsTold;
  follow_scan(now);
}

void SensorCaptureApp::take_scan_command(const scan_command_t& command) {
  const std::int64_t now = utime_now();
  owner_.order({command.command_id,
                command.action == scan_command_t::START,
                command.kind,
                command.longest_duration,
                {command.request, command.job, command.part}},
               now, camera_trouble_);
  follow_scan(now);
}

void SensorCaptureApp::take_camera_command(const camera_command_t& command) {
  if (command_ && command_->command_id == command.command_id) command_->heard = steady_now();
  if (std::find(known_commands_.begin(), known_commands_.end(), command.command_id) !=
      known_commands_.end())
    return;
  known_commands_.push_back(command.command_id);
  if (known_commands_.size() > kCommandsRemembered) known_commands_.pop_front();
  if (owner_.scanning() || !found_) {
    spdlog::warn(fmt::format("camera command {} is refused: {}", command.command_id,
                             found_ ? "a scan is running" : camera_trouble_));
    return;
  }
  // Whole images in place of a region would be taken for what was asked.
  if (command.width > 0 || command.frame_rate > 0) {
    error_ = fmt::format(
        "camera command {} is refused: region and frame rate cannot be commanded yet: send 0 for "
        "both and set them in cell.yaml",
        command.command_id);
    error_until_ = steady_now() + kErrorIsTold;
    return;
  }
  if (command_) end_command("another has come");
  if (command.images == 0) return;  // back to the configured settings
  CameraSettings settings{settings_.exposure_us, settings_.gain_db, false};
  if (command.exposure_us > 0) settings.exposure_us = command.exposure_us;
  if (command.gain_db >= 0) settings.gain_db = command.gain_db;
  settings.laser_on = command.laser == camera_command_t::LASER_ON;
  const std::int64_t now = utime_now();
  command_ = CommandedImages{command.command_id,
                             settings,
                             last_ticket_ + 1,
                             command.images,
                             now + seconds_to_us(settings_.longest_scan_s),
                             steady_now()};
  ask_for(settings, now);
}

void SensorCaptureApp::end_command(const std::string& why) {
  spdlog::warn(fmt::format("camera command {} ends, {} images were not taken: {}",
                           command_->command_id, command_->left, why));
  command_.reset();
}

// Whoever lit the laser outside a scan is gone.
bool SensorCaptureApp::is_unattended() const {
  return command_ && command_->settings.laser_on && steady_now() - command_->heard > kCommandHolds;
}

std::string SensorCaptureApp::laser_state() const {
  if (wired_laser_) return "laser on in every exposure: it is wired to the camera";
  if (!lit_) return "laser off";
  if (owner_.laser_wanted())
    return fmt::format("laser on for scan {}", owner_.state().scan.scan_id);
  if (command_ && command_->settings.laser_on)
    return fmt::format("laser on for camera command {}", command_->command_id);
  return "laser goes off";
}

// Lit in scans, and where a camera command asks for it.
CameraSettings SensorCaptureApp::wanted_settings() const {
  if (command_) return command_->settings;
  return {settings_.exposure_us, settings_.gain_db, owner_.laser_wanted()};
}

void SensorCaptureApp::ask_for(const CameraSettings& settings, std::int64_t now) {
  asked_ = settings;
  lit_ |= settings.laser_on;
  timeline_.requested(++last_ticket_, settings, now);
  source_->request(last_ticket_, settings);
}

void SensorCaptureApp::publish_image(image_t& image, Frame& frame, const Membership& membership,
                                     std::int64_t command_id) {
  image.scan_id = membership.scan_id;
  image.scan_index = membership.scan_index;
  image.command_id = command_id;
  put_pixels(image, frame, settings_.encoding == "png");
  bus_.publish(instance_.sensor_channel("IMAGE"), image);
}

// Tells all stages, in the images' own order, that no image of the scan comes any more: so no
// single lost message leaves it open, and what was lost at its end is counted as any other.
void SensorCaptureApp::publish_end(image_t image) {
  --ends_left_;
  image.incomplete = "not sent: it only tells that the scan before it has ended";
  bus_.publish(instance_.sensor_channel("IMAGE"), image);
}

void SensorCaptureApp::publish_scan(std::int64_t now) {
  scan_t message = make_scan_message(owner_.state());
  message.utime = now;
  message.run_id = run_id_;
  probes_.fill_in(message);
  bus_.publish(instance_.sensor_channel("SCAN"), message);
  told_revision_ = owner_.revision();
  next_scan_state_ = steady_now() + kScanStatePeriod;
}

Health SensorCaptureApp::health() const {
  Health health;
  const SourceCounts counts = source_->counts();
  health.received = counts.frames;
  health.lost = counts.incomplete + counts.lost;
  health.last_error = error_.empty() ? probes_.trouble() : error_;
  if (found_) health.notice = laser_state();
  if (starting_) {
    health.state = service_status_t::STARTING;
  } else if (!found_) {
    health.state = service_status_t::FAULT;
    health.last_error = camera_trouble_;
  } else if (!health.last_error.empty()) {
    health.state = service_status_t::DEGRADED;
  }
  return health;
}

}  // namespace arcstart::sensor_capture
