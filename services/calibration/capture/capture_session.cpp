#include "services/calibration/capture/capture_session.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "common/time.hpp"
#include "services/calibration/files/calibration_file.hpp"
#include "services/calibration/files/whole_file.hpp"
#include "services/calibration/solve/calibration_result.hpp"
#include "services/extraction/files/image_decoding.hpp"

namespace arcstart::calibration {
namespace {

constexpr std::int64_t kStatePeriod = 1'000'000;  // us
constexpr std::size_t kCommandsRemembered = 256;

PoseCaptureSettings capture_settings(const CalibrationSettings& settings) {
  return {settings.grid_exposure_us, settings.laser_exposure_us, settings.still_duration_s,
          settings.still_distance_mm, settings.still_angle_deg};
}

calibration_pose_t to_message(const KeptPose& pose, const RigidTransform* first) {
  calibration_pose_t message{};
  message.index = pose.view.index;
  message.usable = pose.view.unusable.empty();
  message.reason = pose.view.unusable;
  message.located = pose.T_camera_plate.has_value();
  if (!message.located) return message;
  const Eigen::Vector3d normal = pose.T_camera_plate->linear().col(2);
  message.tilt = std::atan2(normal.head<2>().norm(), std::abs(normal.z()));
  const Eigen::Matrix3d turn = pose.T_camera_plate->linear() * first->linear().transpose();
  message.roll = std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
  message.distance = pose.T_camera_plate->translation().z();
  return message;
}

cv::Mat decoded(const image_t& image, std::string& trouble) {
  cv::Mat grey;
  if (!image.incomplete.empty())
    trouble = image.incomplete;
  else if (image.width != image.sensor_width || image.height != image.sensor_height)
    trouble = "the image shows a part of the sensor: a calibration needs all of it";
  else if (image.encoding == image_t::PNG)
    trouble = extraction::decode_grey_png(image.data.data(), image.data.size(), image.width,
                                          image.height, grey);
  else if (image.encoding != image_t::MONO8)
    trouble = fmt::format("encoding {} is not read yet: send MONO8 or PNG", image.encoding);
  else
    grey = cv::Mat(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.data.data()))
               .clone();
  return grey;
}

}  // namespace

CaptureSession::CaptureSession(Bus& bus, const CalibrationSettings& settings,
                               const Instance& instance, std::int64_t run_id)
    : bus_(bus),
      settings_(settings),
      instance_(instance),
      capture_(capture_settings(settings)),
      set_(settings.folder, settings.plate) {
  state_.run_id = run_id;
  bus_.subscribe<calibration_command_t>(
      instance.sensor_channel("CALIBRATION_COMMAND"), Queue::measurements(),
      [this](const calibration_command_t& command) { take_command(command); });
  bus_.subscribe<image_t>(instance.sensor_channel("IMAGE"), Queue::images(),
                          [this](const image_t& image) { take_image(image); });
  bus_.subscribe<robot_pose_t>(
      instance.robot_channel("POSE"), Queue::measurements(), [this](const robot_pose_t& pose) {
        if (pose.invalid.empty())
          capture_.take_position(pose.utime, transform_from_arrays(pose.position, pose.quaternion));
      });
}

void CaptureSession::take_command(const calibration_command_t& command) {
  if (std::find(known_commands_.begin(), known_commands_.end(), command.command_id) !=
      known_commands_.end())
    return;
  known_commands_.push_back(command.command_id);
  if (known_commands_.size() > kCommandsRemembered) known_commands_.pop_front();
  const std::int64_t now = utime_now();
  changed_ = true;
  state_.command_id = command.command_id;
  state_.refusal.clear();
  if (state_.state != calibration_capture_t::IDLE) {
    state_.refusal = "another command is being carried out: wait for it";
  } else if (command.action == calibration_command_t::CAPTURE) {
    state_.state = calibration_capture_t::CAPTURING;
    capture_.begin(now);
  } else if (command.action == calibration_command_t::DISCARD) {
    begin_work(calibration_capture_t::CAPTURING, "looks at what is left", [this, command] {
      if (!set_.discard(command.pose))
        throw CalibrationSetError(fmt::format("there is no pose {}", command.pose));
      return Result{};
    });
  } else {
    begin_work(calibration_capture_t::SOLVING, "calibrates", [this] { return solve(); });
  }
}

void CaptureSession::take_image(const image_t& image) {
  if (image.command_id == 0 || !capture_.is_running()) return;
  std::string trouble;
  const cv::Mat grey = decoded(image, trouble);
  capture_.take_image(image.command_id, image.utime, image.laser_on, grey, trouble);
}

void CaptureSession::begin_work(std::int8_t state, std::string activity, Work work) {
  state_.state = state;
  state_.activity = std::move(activity);
  changed_ = true;
  work_ = std::async(std::launch::async, [work = std::move(work)] {
    try {
      return work();
    } catch (const std::exception& error) {
      return Result{error.what(), "", ""};
    }
  });
}

void CaptureSession::finish_work() {
  Result result = work_.get();
  if (!result.failure.empty()) spdlog::warn(fmt::format("calibration: {}", result.failure));
  if (!result.verdict.empty()) {
    spdlog::info(fmt::format("calibration {}: {}", result.calibration_id, result.verdict));
    state_.calibration_id = std::move(result.calibration_id);
    state_.verdict = std::move(result.verdict);
  }
  state_.refusal = std::move(result.failure);
  state_.state = calibration_capture_t::IDLE;
  state_.activity.clear();
  changed_ = true;
}

void CaptureSession::tick(std::int64_t now) {
  if (work_.valid() && work_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    finish_work();
  if (const auto wanted = capture_.wanted(now)) {
    camera_command_t command{};
    command.utime = now;
    command.command_id = wanted->command_id;
    command.exposure_us = wanted->exposure_us;
    command.gain_db = -1;
    command.laser = wanted->laser_on ? camera_command_t::LASER_ON : camera_command_t::LASER_OFF;
    command.images = 1;
    bus_.publish(instance_.sensor_channel("CAMERA_COMMAND"), command);
  }
  if (auto outcome = capture_.tick(now)) {
    changed_ = true;
    if (outcome->pose)
      begin_work(state_.state, "looks at the images", [this, pose = std::move(*outcome->pose)] {
        set_.add(pose);
        return Result{};
      });
    else {
      state_.state = calibration_capture_t::IDLE;
      state_.refusal = outcome->failure;
    }
  }
  if (!work_.valid() && state_.activity != capture_.activity()) {
    state_.activity = capture_.activity();
    changed_ = true;
  }
  if (changed_ || now - told_ >= kStatePeriod || now < told_) publish(now);
}

// The result lies beside the images; the cell's own file, which is read and published as any other,
// is replaced by what is within the limits alone.
CaptureSession::Result CaptureSession::solve() const {
  CalibrationNames names{instance_.sensor, instance_.robot, settings_.tool, 0, utime_now()};
  try {
    names.time_offset = read_calibration_file(settings_.file).time_offset;
  } catch (const CalibrationFileError&) {
    // None so far: images at rest say nothing of it.
  }
  const CalibrationRun run = set_.solve();
  if (!run.refused.empty()) throw CalibrationSetError("refused: " + run.refused);
  if (!run.has_laser)
    throw CalibrationSetError("refused: no usable pose shows a straight stripe on the plate");
  const auto missed = missed_limits(run, settings_.limits);
  Calibration calibration = to_calibration(run, names);
  calibration.verdict = verdict_of(run, settings_.limits);
  const std::string text = calibration_file_text(calibration);
  const std::string name = set_.folder() + "/calibration";
  write_whole(name + (missed.empty() ? ".yaml" : ".failed.yaml"), text);
  write_whole(name + ".html", set_.report(run, settings_.limits));
  if (missed.empty()) replace_calibration_file(settings_.file, text);
  Result result;
  result.calibration_id = parse_calibration(text, name + ".yaml").id;
  result.verdict = fmt::format(
      "{}; {} poses, laser points of poses it never saw lie within {:.3f} mm RMS; report: {}.html",
      missed.empty() ? "in force" : "not in force, a limit is missed: " + missed.front(),
      run.views.size(), run.left_one_out.laser_rms_mm, name);
  return result;
}

void CaptureSession::publish(std::int64_t now) {
  told_ = now;
  changed_ = false;
  state_.utime = now;
  if (!work_.valid()) {
    state_.poses.clear();
    const RigidTransform* first = nullptr;
    for (const KeptPose& pose : set_.poses()) {
      if (!first && pose.T_camera_plate) first = &*pose.T_camera_plate;
      state_.poses.push_back(to_message(pose, first));
    }
    state_.pose_count = static_cast<std::int32_t>(state_.poses.size());
    state_.advice = set_.advice();
  }
  bus_.publish(instance_.sensor_channel("CALIBRATION_CAPTURE"), state_);
}

}  // namespace arcstart::calibration
