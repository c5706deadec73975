#include "services/command_line/imports/imported_messages.hpp"

#include <algorithm>

#include "common/bus/crc32c.hpp"

namespace arcstart::command_line {
namespace {

constexpr std::int64_t kMargin = 1000;  // us: a scan reaches so far beyond its first and last image

}  // namespace

std::int64_t ImportedScan::begin_utime() const { return folder->frames.front().utime - kMargin; }
std::int64_t ImportedScan::end_utime() const { return folder->frames.back().utime + kMargin; }

scan_t scan_message(const ImportedScan& scan, const ImportedScan* previous, std::int64_t utime) {
  const auto& frames = scan.folder->frames;
  const auto sent =
      std::lower_bound(frames.begin(), frames.end(), utime,
                       [](const StampedFrame& frame, std::int64_t t) { return frame.utime < t; }) -
      frames.begin();
  const bool ended = utime >= scan.end_utime();
  scan_t message{};
  message.utime = utime;
  message.run_id = scan.run_id;
  message.state = ended ? scan_t::ENDED : scan_t::SCANNING;
  message.scan_id = message.begin_utime = scan.begin_utime();
  message.kind = scan.kind;
  message.end_utime = ended ? scan.end_utime() : 0;
  message.first_seq = sent > 0 ? scan.first_seq : -1;
  message.last_seq = sent > 0 ? scan.first_seq + sent - 1 : -1;
  message.images = static_cast<std::int32_t>(sent);
  message.end_cause = ended ? scan_t::STOP : scan_t::NONE;
  message.end_reason = ended ? "import: after the last image" : "";
  message.job = scan.job;
  message.part = scan.part;
  message.clock_bound = 0;  // one clock: whoever writes the files vouches for it
  message.previous_first_seq = message.previous_last_seq = -1;
  if (previous) {
    const auto count = static_cast<std::int32_t>(previous->folder->frames.size());
    message.previous_scan_id = previous->begin_utime();
    message.previous_kind = previous->kind;
    message.previous_end_cause = scan_t::STOP;
    message.previous_end_utime = previous->end_utime();
    message.previous_first_seq = previous->first_seq;
    message.previous_last_seq = previous->first_seq + count - 1;
    message.previous_images = count;
  }
  return message;
}

image_t image_message(const ImportedScan& scan, std::size_t place, const cv::Mat& grey) {
  const StampedFrame& frame = scan.folder->frames[place];
  image_t message{};
  message.utime = message.arrival_utime = frame.utime;
  message.run_id = scan.run_id;
  message.seq = scan.first_seq + static_cast<std::int64_t>(place);
  message.scan_id = scan.begin_utime();
  message.scan_index = static_cast<std::int32_t>(place);
  message.width = message.sensor_width = static_cast<std::int16_t>(grey.cols);
  message.height = message.sensor_height = static_cast<std::int16_t>(grey.rows);
  message.laser_on = true;
  message.encoding = image_t::MONO8;
  message.data.reserve(grey.total());
  for (int v = 0; v < grey.rows; ++v)
    message.data.insert(message.data.end(), grey.ptr(v), grey.ptr(v) + grey.cols);
  message.size = static_cast<std::int32_t>(message.data.size());
  message.crc32c = crc32c(message.data);
  return message;
}

robot_pose_t pose_message(const StampedPose& pose, std::int64_t run_id, std::int64_t seq) {
  robot_pose_t message{};
  message.utime = message.arrival_utime = pose.utime;
  message.run_id = run_id;
  message.seq = seq;
  transform_to_arrays(pose.T_base_tool, message.position, message.quaternion);
  message.source = robot_pose_t::UNKNOWN;
  message.tool_frame = message.user_frame = -1;
  return message;
}

}  // namespace arcstart::command_line
