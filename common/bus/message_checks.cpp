#include "common/bus/message_checks.hpp"

#include <fmt/core.h>

#include <cmath>

#include "common/bus/crc32c.hpp"
#include "common/bus/value_checks.hpp"

namespace arcstart {
namespace {

// Bytes that an image of this encoding must have, -1 where that is not fixed.
std::int64_t bytes_of(const image_t& m) {
  if (m.encoding == image_t::PNG) return -1;
  return std::int64_t{m.width} * m.height * (m.encoding == image_t::MONO16 ? 2 : 1);
}

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
      .require(m.encoding >= image_t::MONO8 && m.encoding <= image_t::BAYER_BG8,
               "unknown encoding");
  if (m.incomplete.empty())
    checks.require(m.width > 0 && m.height > 0 && m.size > 0, "no bytes, and no reason why")
        .require(bytes_of(m) < 0 || m.size == bytes_of(m), "bytes are not width x height");
  else
    checks.require(m.size == 0, "bytes of an incomplete image");
  // Last, and only where the rest is in order: it reads every byte.
  if (checks.error().empty())
    checks.require(m.crc32c == (m.size > 0 ? std::int64_t{crc32c(m.data)} : 0),
                   "bytes do not have their CRC-32C: damaged on the way or on the disk");
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
      .require(m.source >= robot_pose_t::UNKNOWN && m.source <= robot_pose_t::RTDE,
               "unknown source")
      .require(m.tool_frame >= -1 && m.user_frame >= -1, "frame number below -1")
      .require(!m.invalid.empty() || is_unit(m.quaternion, 4), "quaternion not of unit length");
  return checks.error();
}

std::string meaning_error(const stripe_t& m) {
  Checks checks = check_source(m);
  checks.require(m.sensor_width >= 0 && m.sensor_height >= 0, "sensor size below 0")
      .require(m.why >= stripe_t::NONE && m.why <= stripe_t::UNKNOWN_ENCODING, "unknown reason")
      .require(m.count > 0 || m.why != stripe_t::NONE, "no centres, and no reason why")
      .require(m.count == 0 || m.why == stripe_t::NONE, "centres, and a reason why there are none")
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
  checks.require(m.why >= profile_t::NONE && m.why <= profile_t::WRONG_TIME, "unknown reason")
      .require(m.count > 0 || m.why != profile_t::NONE, "no points, and no reason why")
      .require(m.count == 0 || m.why == profile_t::NONE, "points, and a reason why there are none")
      .require(are_lengths(m.x) && are_lengths(m.y) && are_lengths(m.z), "points not finite")
      .require(are_lengths(m.u) && are_lengths(m.v) && all_finite(m.deviation),
               "centres not finite")
      .require(are_lengths(m.tool_position) && are_lengths(m.camera_centre),
               "tool or camera not finite")
      .require(m.count == 0 || is_unit(m.tool_quaternion, 4), "tool quaternion not of unit length")
      .require(all_finite(m.tool_quaternion), "tool quaternion not finite");
  for (int i = 0; i < m.count; ++i)
    checks.require(m.segment[i] >= 0 && m.segment_end[i] >= profile_t::CONTINUES &&
                       m.segment_end[i] <= profile_t::SATURATION,
                   "unknown segment or segment end");
  return checks.error();
}

std::string meaning_error(const scan_t& m) {
  Checks checks;
  checks.require(m.utime > 0 && m.run_id > 0, "utime or run_id below 0")
      .require(m.state >= scan_t::IDLE && m.state <= scan_t::ENDED, "unknown state")
      .require(m.kind == scan_t::BACKGROUND || m.kind == scan_t::WORKPIECE, "unknown kind")
      .require(m.scan_id >= 0 && m.images >= 0 && m.lost >= 0, "scan_id, images or lost below 0")
      .require(m.end_cause >= scan_t::NONE && m.end_cause <= scan_t::CAMERA_LOST &&
                   m.previous_end_cause >= scan_t::NONE &&
                   m.previous_end_cause <= scan_t::CAMERA_LOST,
               "unknown end cause")
      .require((m.state == scan_t::ENDED) == (m.end_cause != scan_t::NONE),
               "ended without a cause, or a cause without an end")
      .require(m.previous_scan_id == 0 || m.previous_end_cause != scan_t::NONE,
               "the scan before ended without a cause")
      .require(is_name(m.job) && is_name(m.part), kNoName)
      .require(std::isfinite(m.clock_difference) && is_known_or_not(m.clock_bound),
               "clock difference or its bound")
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
               "longest duration must be above 0 and at most 3600 s")
      .require(is_name(m.job) && is_name(m.part), kNoName);
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
      .require(m.images >= 0 && m.images <= 10000, "number of images must lie between 0 and 10000")
      .require(m.offset_u >= 0 && m.offset_v >= 0 && m.width >= 0 && m.height >= 0 &&
                   (m.width > 0) == (m.height > 0),
               "region")
      .require(std::isfinite(m.frame_rate) && m.frame_rate >= 0, "frame rate");
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
      .require(m.passed >= calibration_t::NOT_JUDGED && m.passed <= calibration_t::FAILED,
               "unknown judgement")
      .require(is_known_or_not(m.camera_limit) && is_known_or_not(m.laser_plane_limit) &&
                   is_known_or_not(m.leave_one_out_limit) && is_known_or_not(m.predicted_limit) &&
                   is_known_or_not(m.robot_position_limit) &&
                   is_known_or_not(m.robot_orientation_limit) && m.poses >= -1,
               "limits or number of poses")
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
      .require((m.verdict == seam_t::REFUSED || m.verdict == seam_t::AMBIGUOUS)
                   ? m.refusal > seam_t::SCAN_AGAIN && m.refusal < seam_t::STOP + 100
                   : m.refusal == 0,
               "no seam without a refusal's code, or a code beside a seam")
      .require(m.usable >= seam_t::USABLE && m.usable <= seam_t::CLOCKS_APART,
               "unknown reason against its use")
      .require(is_name(m.job) && is_name(m.part), kNoName)
      .require(are_lengths(m.start_second) && are_lengths(m.end_second) &&
                   is_weight(m.start_second_weight) && is_weight(m.end_second_weight),
               "second place of an end")
      .require(is_known_or_not(m.thickness) && is_known_or_not(m.mismatch) &&
                   is_known_or_not(m.groove_angle),
               "thickness, mismatch or groove angle")
      .require(m.stripes_checked >= -1 && is_known_or_not(m.explained_share) &&
                   m.explained_share <= 1 && is_known_or_not(m.worst_contradiction),
               "what was checked against the stripes")
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

std::string meaning_error(const clock_probe_t& m) {
  Checks checks;
  checks.require(!m.robot.empty(), "no robot named")
      .require(is_time(m.asker_run_id) && is_time(m.asked_utime) && m.seq >= 0,
               "asker_run_id or asked_utime is no time, or seq below 0")
      .require(m.answerer_run_id == 0 ||
                   (is_time(m.answerer_run_id) && is_time(m.heard_utime) &&
                    is_time(m.answered_utime) && m.answered_utime >= m.heard_utime),
               "an answer whose stamps are no times, or that was sent before it was asked");
  return checks.error();
}

std::string meaning_error(const delivery_t& m) {
  Checks checks;
  checks.require(is_time(m.utime) && is_time(m.run_id), "utime or run_id is no time")
      .require(m.progress >= delivery_t::NOTHING && m.progress <= delivery_t::DONE,
               "progress is none of delivery_t's")
      .require(m.request >= 0 && m.verdict >= 0 && m.delivered_utime >= 0 && m.scan_id >= 0,
               "a number below 0")
      .require(is_name(m.job) && is_name(m.part), kNoName)
      .require(are_lengths(m.approach) && are_lengths(m.start) && are_lengths(m.end),
               "a position that is no length")
      .require(is_unit(m.quaternion, 4), "the quaternion is not of length 1");
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
