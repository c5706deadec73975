// How a buffer of Aravis' becomes a frame.
#include <arv.h>
#include <fmt/core.h>

#include <utility>

#include "services/sensor_capture/sources/aravis_camera.hpp"

namespace arcstart::sensor_capture {
namespace {

// Pixels and region of a complete buffer, or why there are none.
void take_pixels(ArvBuffer* buffer, Frame& frame) {
  arv_buffer_get_image_region(buffer, &frame.offset_u, &frame.offset_v, &frame.width,
                              &frame.height);
  std::size_t size = 0;
  const auto* pixels = static_cast<const std::uint8_t*>(arv_buffer_get_data(buffer, &size));
  const auto count = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
  if (count > 0 && size >= count)
    frame.pixels.assign(pixels, pixels + count);
  else
    frame.incomplete = "fewer bytes than width x height";
}

std::string incomplete_reason(ArvBuffer* buffer) {
  switch (arv_buffer_get_status(buffer)) {
    case ARV_BUFFER_STATUS_SUCCESS:
      return arv_buffer_get_image_pixel_format(buffer) == ARV_PIXEL_FORMAT_MONO_8
                 ? ""
                 : "the camera sends another pixel format than Mono8";
    case ARV_BUFFER_STATUS_TIMEOUT:
      return "packets did not come in time";
    case ARV_BUFFER_STATUS_MISSING_PACKETS:
      return "packets are missing";
    case ARV_BUFFER_STATUS_SIZE_MISMATCH:
      return "the frame does not fit its buffer";
    case ARV_BUFFER_STATUS_ABORTED:
      return "the camera was stopped";
    default:
      return "its packets are out of order";
  }
}

}  // namespace

std::optional<AravisCamera::NumberedFrame> AravisCamera::next() {
  while (ArvBuffer* buffer = arv_stream_try_pop_buffer(stream_.get())) {
    NumberedFrame numbered{arv_buffer_get_frame_id(buffer), {}};
    Frame& frame = numbered.frame;
    frame.device_time_ns = static_cast<std::int64_t>(arv_buffer_get_timestamp(buffer));
    frame.arrival_utime = static_cast<std::int64_t>(arv_buffer_get_system_timestamp(buffer) / 1000);
    // Without its leader a frame never began here: the gap in the camera's count shows it. The
    // first one after a start may have been cut.
    const bool first = std::exchange(first_frame_, false);
    const bool begun = frame.device_time_ns != 0 && !first;
    if (begun) {
      frame.sensor_width = sensor_width_;
      frame.sensor_height = sensor_height_;
      frame.incomplete = incomplete_reason(buffer);
      if (frame.incomplete.empty()) take_pixels(buffer, frame);
    }
    // Else a buffer whose next leader is lost would carry the stamp of this one.
    arv_buffer_set_timestamp(buffer, 0);
    arv_buffer_set_system_timestamp(buffer, 0);
    arv_stream_push_buffer(stream_.get(), buffer);
    if (begun) return numbered;
  }
  return std::nullopt;
}

std::string AravisCamera::statistics() const {
  guint64 completed = 0, failures = 0, underruns = 0;
  arv_stream_get_statistics(stream_.get(), &completed, &failures, &underruns);
  const auto info = [&](const char* name) {
    return arv_stream_get_info_uint64_by_name(stream_.get(), name);
  };
  return fmt::format(
      "{} frames complete, {} failed, {} without a buffer, {} packets missing, {} "
      "sent again",
      completed, failures, underruns, info("n_missing_packets"), info("n_resent_packets"));
}

}  // namespace arcstart::sensor_capture
