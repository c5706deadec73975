// Frames and scans as messages.
#pragma once

#include <arcstart/image_t.hpp>
#include <arcstart/scan_t.hpp>

#include "services/sensor_capture/frames/frame_source.hpp"
#include "services/sensor_capture/frames/settings_timeline.hpp"
#include "services/sensor_capture/scan/scan_owner.hpp"

namespace arcstart::sensor_capture {

// Everything but the pixels, the run and the scan. begin_utime: of the exposure; us, UTC.
image_t make_image_message(const Frame& frame, std::int64_t begin_utime,
                           const SettingsTimeline::InForce& in_force);

// The frame's pixels are moved into the image, or coded as PNG.
void put_pixels(image_t& image, Frame& frame, bool as_png);

// At most 50 KB.
image_t make_preview_message(const image_t& image, const Frame& frame);

// Everything but utime and run_id.
scan_t make_scan_message(const ScanState& state);

}  // namespace arcstart::sensor_capture
