#include "common/message_checks.hpp"

#include <fmt/core.h>

#include <cmath>

namespace arcstart {
namespace {

constexpr double kLongest = 1e7;  // mm: ten kilometres; nothing in a cell is farther away

template <class List>
bool all_finite(const List& values) {
  for (const double value : values)
    if (!std::isfinite(value) || std::abs(value) > 1e30) return false;
  return true;
}

// Before the year 10000: a stamp to which any setting in seconds can be added.
bool is_time(std::int64_t utime) { return utime > 0 && utime < 253'402'300'800'000'000; }

bool is_length(double value) { return std::isfinite(value) && std::abs(value) <= kLongest; }

template <class List>
bool are_lengths(const List& values) {
  for (const double value : values)
    if (!is_length(value)) return false;
  return true;
}

bool is_unit(const double* values, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += values[i] * values[i];
  return std::abs(sum - 1) < 1e-6;
}

// Collects the first condition that fails.
class Checks {
 public:
  Checks& require(bool condition, const char* why) {
    if (!condition && error_.empty()) error_ = why;
    return *this;
  }
  const std::string& error() const { return error_; }

 private:
  std::string error_;
};

template <class Message>
Checks check_source(const Message& message) {
  Checks checks;
  checks
      .require(is_time(message.utime) && is_time(message.run_id) && message.seq >= 0,
               "utime or run_id is no time, or seq below 0")
      .require(message.scan_id >= 0 && message.scan_index >= -1, "scan_id or scan_index below 0");
  return checks;
}

}  // namespace

std::string meaning_error(const image_t& m) {
  Checks checks = check_source(m);
  checks
      .require(m.width >= 0 && m.height >= 0 && m.offset_u >= 0 && m.offset_v >= 0,
               "size or offset below 0")
      .require(m.offset_u + m.width <= m.sensor_width && m.offset_v + m.height <= m.sensor_height,
               "region outside the sensor")
      .require(std::isfinite(m.exposure_us) && std::isfinite(m.gain_db),
               "exposure or gain not finite")
      .require(m.encoding == image_t::MONO8 || m.encoding == image_t::PNG, "unknown encoding");
  if (m.incomplete.empty())
    checks.require(m.width > 0 && m.height > 0 && m.size > 0, "no bytes, and no reason why")
        .require(m.encoding != image_t::MONO8 || m.size == m.width * m.height,
                 "bytes are not width x height");
  else
    checks.require(m.size == 0, "bytes of an incomplete image");
  return checks.error();
}

std::string meaning_error(const robot_pose_t& m) {
  Checks checks;
  checks
      .require(is_time(m.utime) && is_time(m.run_id) && m.seq >= 0,
               "utime or run_id is no time, or seq below 0")
      .require(are_lengths(m.position), "position not finite")
      .require(all_finite(m.joints), "joints not finite")
      .require(std::isfinite(m.device_tick_us), "tick not finite")
      .require(!m.invalid.empty() || is_unit(m.quaternion, 4), "quaternion not of unit length");
  return checks.error();
}

std::string meaning_error(const stripe_t& m) {
  Checks checks = check_source(m);
  checks.require(m.sensor_width >= 0 && m.sensor_height >= 0, "sensor size below 0")
      .require(m.count > 0 || !m.empty.empty(), "no centres, and no reason why")
      .require(are_lengths(m.u) && are_lengths(m.v), "centres not finite")
      .require(all_finite(m.strength) && all_finite(m.width) && all_finite(m.deviation),
               "quality not finite")
      .require(std::isfinite(m.sigma) && std::isfinite(m.noise) && std::isfinite(m.saturated_share),
               "image's quality not finite");
  for (int i = 0; i < m.count; ++i)
    checks.require(m.segment[i] >= 0 && m.rank[i] >= 0 && m.segment_end[i] >= stripe_t::CONTINUES &&
                       m.segment_end[i] <= stripe_t::SATURATION,
                   "unknown segment, rank or segment end");
  return checks.error();
}

std::string meaning_error(const profile_t& m) {
  Checks checks = check_source(m);
  checks.require(m.count > 0 || !m.empty.empty(), "no points, and no reason why")
      .require(are_lengths(m.x) && are_lengths(m.y) && are_lengths(m.z), "points not finite")
      .require(are_lengths(m.u) && are_lengths(m.v) && all_finite(m.deviation),
               "centres not finite")
      .require(are_lengths(m.tool_position) && are_lengths(m.camera_centre),
               "tool or camera not finite")
      .require(m.count == 0 || is_unit(m.tool_quaternion, 4), "tool quaternion not of unit length")
      .require(all_finite(m.tool_quaternion), "tool quaternion not finite");
  for (int i = 0; i < m.count; ++i)
    checks.require(m.segment[i] >= 0 && (m.segment_end[i] == profile_t::INSIDE ||
                                         m.segment_end[i] == profile_t::SEGMENT_END),
                   "unknown segment or segment end");
  return checks.error();
}

std::string meaning_error(const scan_t& m) {
  Checks checks;
  checks.require(m.utime > 0 && m.run_id > 0, "utime or run_id below 0")
      .require(m.state >= scan_t::IDLE && m.state <= scan_t::ENDED, "unknown state")
      .require(m.kind == scan_t::BACKGROUND || m.kind == scan_t::WORKPIECE, "unknown kind")
      .require(m.scan_id >= 0 && m.images >= 0 && m.lost >= 0, "scan_id, images or lost below 0")
      .require(m.state != scan_t::ENDED || m.end_utime >= m.begin_utime, "ends before it begins");
  return checks.error();
}

std::string meaning_error(const scan_command_t& m) {
  Checks checks;
  checks.require(m.utime > 0 && m.command_id != 0, "utime or command_id is 0")
      .require(m.action == scan_command_t::START || m.action == scan_command_t::STOP,
               "unknown action")
      .require(m.kind == scan_t::BACKGROUND || m.kind == scan_t::WORKPIECE, "unknown kind")
      .require(m.action != scan_command_t::START ||
                   (m.longest_duration > 0 && m.longest_duration <= 3600),
               "longest duration must be above 0 and at most 3600 s");
  return checks.error();
}

std::string meaning_error(const camera_command_t& m) {
  Checks checks;
  checks.require(m.utime > 0 && m.command_id != 0, "utime or command_id is 0")
      .require(std::isfinite(m.exposure_us) && m.exposure_us >= 0 && std::isfinite(m.gain_db),
               "exposure or gain")
      .require(m.laser >= camera_command_t::LASER_OFF &&
                   m.laser <= camera_command_t::LASER_AS_CONFIGURED,
               "unknown laser setting")
      .require(m.images >= 0 && m.images <= 10000, "number of images must lie between 0 and 10000");
  return checks.error();
}

std::string meaning_error(const calibration_t& m) {
  Checks checks;
  checks.require(!m.id.empty(), "no id")
      .require(m.width > 0 && m.height > 0, "image size not above 0")
      .require(all_finite(m.camera_matrix) && all_finite(m.distortion), "camera not finite")
      .require(are_lengths(m.laser_plane) && is_unit(m.laser_plane, 3),
               "laser plane's normal not of unit length")
      .require(are_lengths(m.camera_position) && is_unit(m.camera_quaternion, 4),
               "hand-eye has no unit quaternion")
      .require(std::isfinite(m.time_offset) && std::abs(m.time_offset) < 10,
               "time offset beyond 10 s")
      .require(m.covariance_size == 0 || m.covariance_size == calibration_t::PARAMETERS,
               "covariance of wrong size");
  for (const auto& row : m.pixel_to_camera) checks.require(all_finite(row), "M not finite");
  for (const auto& row : m.covariance) checks.require(all_finite(row), "covariance not finite");
  return checks.error();
}

std::string meaning_error(const calibration_command_t& m) {
  Checks checks;
  checks.require(m.utime > 0 && m.command_id != 0, "utime or command_id is 0")
      .require(
          m.action >= calibration_command_t::CAPTURE && m.action <= calibration_command_t::SOLVE,
          "unknown action")
      .require(m.pose >= -1, "pose below -1");
  return checks.error();
}

std::string meaning_error(const calibration_capture_t& m) {
  Checks checks;
  checks.require(m.utime > 0 && m.run_id > 0, "utime or run_id below 0")
      .require(m.state >= calibration_capture_t::IDLE && m.state <= calibration_capture_t::SOLVING,
               "unknown state");
  for (const auto& pose : m.poses)
    checks.require(std::isfinite(pose.tilt) && std::isfinite(pose.roll) && is_length(pose.distance),
                   "pose not finite");
  return checks.error();
}

std::string meaning_error(const seam_t& m) {
  Checks checks;
  checks
      .require(m.verdict >= seam_t::FOUND && m.verdict <= seam_t::BACKGROUND_STORED,
               "unknown verdict")
      .require(
          m.verdict == seam_t::FOUND || m.verdict == seam_t::BACKGROUND_STORED || !m.reason.empty(),
          "no seam, and no reason why")
      .require(are_lengths(m.start) && are_lengths(m.end) && all_finite(m.direction),
               "seam not finite")
      .require(m.verdict != seam_t::FOUND || is_unit(m.direction, 3),
               "direction not of unit length");
  for (const auto& vertex : m.polyline) checks.require(are_lengths(vertex), "polyline not finite");
  return checks.error();
}

std::string meaning_error(const service_status_t& m) {
  Checks checks;
  checks.require(m.utime > 0 && m.run_id > 0, "utime or run_id below 0")
      .require(m.state >= service_status_t::STARTING && m.state <= service_status_t::STOPPING,
               "unknown state");
  return checks.error();
}

std::string meaning_error(const cell_command_t& m) {
  Checks checks;
  checks.require(m.utime > 0 && m.command_id != 0, "utime or command_id is 0")
      .require(m.scene >= cell_command_t::KEEP && m.scene <= cell_command_t::PLATE, "unknown scene")
      .require(m.plate_pose >= 0 && m.plate_pose <= 10000,
               "plate_pose must lie between 0 and 10000")
      .require(!m.move || (are_lengths(m.position) && is_unit(m.quaternion, 4)),
               "pose not finite or not of unit length");
  return checks.error();
}

std::string meaning_error(const truth_t& m) {
  Checks checks;
  checks.require(m.utime > 0, "utime below 0")
      .require(are_lengths(m.start) && are_lengths(m.end) && all_finite(m.direction),
               "seam not finite");
  return checks.error();
}

}  // namespace arcstart
