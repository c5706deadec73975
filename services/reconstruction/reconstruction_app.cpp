#include "services/reconstruction/reconstruction_app.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "common/bus/calibration_message.hpp"
#include "common/time.hpp"

namespace arcstart::reconstruction {
namespace {

// The three lists of reasons are one.
constexpr bool is(EmptyProfile why, int of_profile) { return static_cast<int>(why) == of_profile; }
static_assert(is(EmptyProfile::kNone, profile_t::NONE) && profile_t::NONE == stripe_t::NONE);
static_assert(is(EmptyProfile::kNoStripe, profile_t::NO_STRIPE) &&
              profile_t::NO_STRIPE == stripe_t::NO_STRIPE);
static_assert(is(EmptyProfile::kTooMuchLight, profile_t::TOO_MUCH_LIGHT) &&
              profile_t::TOO_MUCH_LIGHT == stripe_t::TOO_MUCH_LIGHT);
static_assert(is(EmptyProfile::kIncompleteImage, profile_t::INCOMPLETE_IMAGE) &&
              profile_t::INCOMPLETE_IMAGE == stripe_t::INCOMPLETE_IMAGE);
static_assert(is(EmptyProfile::kLaserOff, profile_t::LASER_OFF) &&
              profile_t::LASER_OFF == stripe_t::LASER_OFF);
static_assert(is(EmptyProfile::kUnreadableImage, profile_t::UNREADABLE_IMAGE) &&
              profile_t::UNREADABLE_IMAGE == stripe_t::UNREADABLE_IMAGE);
static_assert(is(EmptyProfile::kUnknownEncoding, profile_t::UNKNOWN_ENCODING) &&
              profile_t::UNKNOWN_ENCODING == stripe_t::UNKNOWN_ENCODING);
static_assert(is(EmptyProfile::kNoneChosen, profile_t::NONE_CHOSEN));
static_assert(is(EmptyProfile::kNoPosition, profile_t::NO_POSITION));
static_assert(is(EmptyProfile::kNoCalibration, profile_t::NO_CALIBRATION));
static_assert(is(EmptyProfile::kCalibrationChanged, profile_t::CALIBRATION_CHANGED));
static_assert(is(EmptyProfile::kOtherSensor, profile_t::OTHER_SENSOR));
static_assert(is(EmptyProfile::kOutOfRange, profile_t::OUT_OF_RANGE));
static_assert(is(EmptyProfile::kWrongTime, profile_t::WRONG_TIME));
static_assert(profile_t::CONTINUES == stripe_t::CONTINUES && profile_t::EDGE == stripe_t::EDGE &&
              profile_t::GAP == stripe_t::GAP && profile_t::BORDER == stripe_t::BORDER &&
              profile_t::SATURATION == stripe_t::SATURATION);

// The chosen centres alone; second candidates are for those who weigh them.
ReceivedStripe from_message(const stripe_t& message) {
  ReceivedStripe stripe;
  stripe.source = {message.utime, message.run_id, message.seq, message.scan_id, message.scan_index};
  stripe.sensor_width = message.sensor_width;
  stripe.sensor_height = message.sensor_height;
  stripe.why = static_cast<EmptyProfile>(message.why);
  stripe.empty = message.empty;
  if (stripe.why != EmptyProfile::kNone) return stripe;
  stripe.centres.reserve(message.u.size());
  for (std::size_t i = 0; i < message.u.size(); ++i)
    if (message.rank[i] == stripe_t::CHOSEN)
      stripe.centres.push_back({message.u[i], message.v[i], message.deviation[i],
                                message.segment[i], message.segment_end[i]});
  if (stripe.centres.empty()) stripe.why = EmptyProfile::kNoneChosen;
  return stripe;
}

profile_t to_message(const Profile& profile) {
  profile_t message{};
  message.utime = profile.source.utime;
  message.run_id = profile.source.run_id;
  message.seq = profile.source.seq;
  message.scan_id = profile.source.scan_id;
  message.scan_index = profile.source.scan_index;
  message.count = static_cast<std::int32_t>(profile.points.size());
  for (const ProfilePoint& point : profile.points) {
    message.x.push_back(static_cast<float>(point.position.x()));
    message.y.push_back(static_cast<float>(point.position.y()));
    message.z.push_back(static_cast<float>(point.position.z()));
    message.u.push_back(point.centre.u);
    message.v.push_back(point.centre.v);
    message.deviation.push_back(static_cast<float>(point.deviation));
    message.segment.push_back(point.centre.segment);
    message.segment_end.push_back(point.centre.segment_end);
  }
  transform_to_arrays(profile.T_base_tool, message.tool_position, message.tool_quaternion);
  Eigen::Map<Eigen::Vector3d>{message.camera_centre} = profile.camera_centre;
  message.calibration_id = profile.calibration_id;
  message.why = static_cast<std::int8_t>(profile.why);
  message.empty = profile.empty;
  return message;
}

std::vector<std::uint8_t> encoded(const calibration_t& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace

ReconstructionApp::ReconstructionApp(Bus& bus, const ReconstructionSettings& settings,
                                     const Instance& instance)
    : bus_(bus), settings_(settings), instance_(instance), reconstruction_(settings) {
  bus.subscribe<stripe_t>(instance.sensor_channel("STRIPE"), Queue::measurements(),
                          [this](const stripe_t& message) { take_stripe(message); });
  bus.subscribe<robot_pose_t>(instance.robot_channel("POSE"), Queue::measurements(),
                              [this](const robot_pose_t& message) { take_position(message); });
  // Every one in its place among the stripes, not the newest alone: which stripes it holds for
  // hangs on that.
  bus.subscribe<calibration_t>(instance.sensor_channel("CALIBRATION"), Queue::measurements(),
                               [this](const calibration_t& message) { take_calibration(message); });
}

void ReconstructionApp::take_stripe(const stripe_t& message) {
  if (message.scan_id != 0) lost_ += stripes_.missing_before(message.scan_id, message.scan_index);
  arrivals_.push_back(steady_now());
  reconstruction_.take_stripe(from_message(message));
  publish_profiles();
}

void ReconstructionApp::take_position(const robot_pose_t& message) {
  lost_ += positions_.missing_before(message.run_id, message.seq);
  const TrajectoryQueue& trajectory = reconstruction_.trajectory();
  const auto dropped = [&] { return trajectory.dropped_going_back() + trajectory.dropped_jumps(); };
  const std::int64_t dropped_before = dropped();
  position_error_ = message.invalid;
  // Of two senders the first message of the other looks like that of one that was started again.
  const std::int64_t run_before = std::exchange(position_run_, message.run_id);
  const bool other_run = run_before != 0 && run_before != message.run_id;
  const bool disputed = !bus_.dispute(instance_.robot_channel("POSE")).empty();
  if (message.invalid.empty()) {
    reconstruction_.take_position(message.utime,
                                  transform_from_arrays(message.position, message.quaternion),
                                  disputed || other_run);
    if (dropped() != dropped_before) position_error_ = "its stamp jumps or goes back";
  }
  publish_profiles();
}

void ReconstructionApp::take_calibration(const calibration_t& message) try {
  auto calibration = std::make_shared<const Calibration>(calibration_from_message(message));
  if (const auto error = instance_error(*calibration, instance_.sensor, instance_.robot);
      !error.empty())
    throw CalibrationError(error);
  const std::vector<std::uint8_t> bytes = encoded(to_message(*calibration));
  const auto& known = reconstruction_.calibration();
  if (known && known->id == calibration->id && bytes != calibration_bytes_)
    throw CalibrationError("it has the id of the one in force, but other numbers");
  calibration_refused_.clear();
  if (bytes == calibration_bytes_) return;
  calibration_bytes_ = bytes;
  spdlog::info(fmt::format("calibration {} of {}, made by: {}", calibration->id,
                           calibration->sensor, calibration->origin));
  reconstruction_.take_calibration(std::move(calibration));
  publish_profiles();
} catch (const CalibrationError& error) {
  calibration_refused_ =
      fmt::format("{}: calibration {} refused: {}: see arcstart-calibration's file",
                  instance_.sensor_channel("CALIBRATION"), message.id, error.what());
}

void ReconstructionApp::publish_profiles() {
  while (const auto profile = reconstruction_.next()) {
    arrivals_.pop_front();
    bus_.publish(instance_.sensor_channel("PROFILE"), to_message(*profile));
    if (profile->why == EmptyProfile::kNone)
      last_empty_.clear();
    else if (!lies_with_stripe(profile->why))
      last_empty_ =
          fmt::format("{}: stripe {} gave no points: {}", instance_.sensor_channel("PROFILE"),
                      profile->source.seq, profile->empty);
  }
}

Health ReconstructionApp::health() const {
  Health health;
  const TrajectoryQueue& trajectory = reconstruction_.trajectory();
  // Invalid positions are no loss of this service: robot_pose says what is wrong with them.
  health.lost = lost_ + trajectory.dropped_going_back() + trajectory.dropped_jumps();
  health.oldest_age = arrivals_.empty() ? 0 : steady_now() - arrivals_.front();
  if (!calibration_refused_.empty())
    health.last_error = calibration_refused_;
  else if (health.oldest_age > seconds_to_us(settings_.silence_warning_s))
    health.last_error =
        reconstruction_.calibration()
            ? fmt::format("stripes wait for positions on {}: is arcstart-robot-pose running?",
                          instance_.robot_channel("POSE"))
            : fmt::format("stripes wait for {}: is arcstart-calibration running?",
                          instance_.sensor_channel("CALIBRATION"));
  else if (!position_error_.empty())
    health.last_error = fmt::format("{}: a position was dropped: {}",
                                    instance_.robot_channel("POSE"), position_error_);
  else if (!last_empty_.empty())
    health.last_error = last_empty_;
  if (!health.last_error.empty()) health.state = service_status_t::DEGRADED;
  return health;
}

// Groups are scans, or runs: a new one begins anew.
std::int64_t ReconstructionApp::Numbering::missing_before(std::int64_t new_group,
                                                          std::int64_t number) {
  constexpr std::int64_t kMost = 100'000;  // 7 minutes of positions: a wild number says nothing
  const bool follows = new_group == group && last >= 0 && number > last;
  const std::int64_t missing = follows ? number - last - 1 : 0;
  group = new_group;
  last = number;
  return missing <= kMost ? missing : 0;
}

}  // namespace arcstart::reconstruction
