#include "services/sensor_capture/capture_messages.hpp"

#include <opencv2/imgcodecs.hpp>

#include "common/bus/crc32c.hpp"
#include "services/sensor_capture/frames/preview.hpp"

namespace arcstart::sensor_capture {
namespace {

constexpr int kPreviewPixels = 49'000;  // with its header at most 50 KB

static_assert(static_cast<int>(ScanState::Phase::kIdle) == scan_t::IDLE &&
              static_cast<int>(ScanState::Phase::kScanning) == scan_t::SCANNING &&
              static_cast<int>(ScanState::Phase::kEnded) == scan_t::ENDED);
static_assert(static_cast<int>(EndCause::kNone) == scan_t::NONE &&
              static_cast<int>(EndCause::kStop) == scan_t::STOP &&
              static_cast<int>(EndCause::kLongestDuration) == scan_t::LONGEST_DURATION &&
              static_cast<int>(EndCause::kStandstill) == scan_t::STANDSTILL &&
              static_cast<int>(EndCause::kCameraLost) == scan_t::CAMERA_LOST);

const char* to_words(EndCause cause) {
  switch (cause) {
    case EndCause::kNone:
      break;
    case EndCause::kStop:
      return "stop";
    case EndCause::kLongestDuration:
      return "longest duration";
    case EndCause::kStandstill:
      return "tool stood still";
    case EndCause::kCameraLost:
      return "camera lost";
  }
  return "";
}

void put_size_and_checksum(image_t& image) {
  image.size = static_cast<std::int32_t>(image.data.size());
  image.crc32c = image.data.empty() ? 0 : crc32c(image.data);
}

}  // namespace

image_t make_image_message(const Frame& frame, std::int64_t begin_utime,
                           const SettingsTimeline::InForce& in_force) {
  image_t image{};
  image.utime = begin_utime + static_cast<std::int64_t>(in_force.settings.exposure_us / 2);
  image.seq = frame.seq;
  image.scan_index = -1;
  image.width = static_cast<std::int16_t>(frame.width);
  image.height = static_cast<std::int16_t>(frame.height);
  image.offset_u = static_cast<std::int16_t>(frame.offset_u);
  image.offset_v = static_cast<std::int16_t>(frame.offset_v);
  image.sensor_width = static_cast<std::int16_t>(frame.sensor_width);
  image.sensor_height = static_cast<std::int16_t>(frame.sensor_height);
  image.exposure_us = in_force.settings.exposure_us;
  image.gain_db = in_force.settings.gain_db;
  image.laser_on = in_force.lit;
  image.device_time_ns = frame.device_time_ns;
  image.arrival_utime = frame.arrival_utime;
  image.encoding = image_t::MONO8;
  image.incomplete = frame.incomplete;
  return image;
}

void put_pixels(image_t& image, Frame& frame, bool as_png) {
  if (as_png && !frame.pixels.empty()) {
    image.encoding = image_t::PNG;
    // The fastest level: a stripe on black compresses well at any.
    cv::imencode(".png", cv::Mat(frame.height, frame.width, CV_8U, frame.pixels.data()), image.data,
                 {cv::IMWRITE_PNG_COMPRESSION, 1});
  } else {
    image.data = std::move(frame.pixels);
  }
  put_size_and_checksum(image);
}

image_t make_preview_message(const image_t& image, const Frame& frame) {
  Preview preview = reduce_by_maximum(frame.pixels, frame.width, frame.height, kPreviewPixels);
  image_t message = image;
  message.width = static_cast<std::int16_t>(preview.width);
  message.height = static_cast<std::int16_t>(preview.height);
  message.data = std::move(preview.pixels);
  put_size_and_checksum(message);
  return message;
}

scan_t make_scan_message(const ScanState& state) {
  scan_t message{};
  message.state = static_cast<std::int8_t>(state.phase);
  message.scan_id = message.begin_utime = state.scan.scan_id;
  message.command_id = state.command_id;
  message.kind = state.scan.kind;
  message.end_utime = state.scan.end_utime;
  message.first_seq = state.scan.first_seq;
  message.last_seq = state.scan.last_seq;
  message.images = state.scan.images;
  message.lost = state.scan.lost;
  message.end_cause = static_cast<std::int8_t>(state.scan.end_cause);
  message.end_reason = to_words(state.scan.end_cause);
  message.start_command_id = state.scan.start_command_id;
  message.request = state.scan.purpose.request;
  message.job = state.scan.purpose.job;
  message.part = state.scan.purpose.part;
  message.clock_bound = -1;  // filled in by whoever compares the hosts' clocks
  message.refused_command_id = state.refused_command_id;
  message.refusal = state.refusal;
  message.previous_scan_id = state.previous.scan_id;
  message.previous_kind = state.previous.kind;
  message.previous_end_utime = state.previous.end_utime;
  message.previous_end_cause = static_cast<std::int8_t>(state.previous.end_cause);
  message.previous_first_seq = state.previous.first_seq;
  message.previous_last_seq = state.previous.last_seq;
  message.previous_images = state.previous.images;
  message.previous_lost = state.previous.lost;
  return message;
}

}  // namespace arcstart::sensor_capture
