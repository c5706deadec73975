// Where frames come from: the interface that a camera, or a folder of images, stands behind.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace arcstart::sensor_capture {

// What can be changed while the camera runs.
struct CameraSettings {
  double exposure_us = 0;
  double gain_db = 0;
  bool laser_on = false;  // in every exposure

  bool operator==(const CameraSettings&) const = default;
};

struct Frame {
  std::int64_t seq = 0;       // rises by 1, and by 1 more for each frame that was lost before it
  int width = 0, height = 0;  // px
  int offset_u = 0, offset_v = 0;           // of the region on the sensor; px
  int sensor_width = 0, sensor_height = 0;  // px
  std::int64_t device_time_ns = 0;          // start of the exposure, the camera's clock
  std::int64_t arrival_utime = 0;           // first packet at the host; us, UTC
  std::vector<std::uint8_t> pixels;         // 8 bit grey, row by row; empty for an incomplete frame
  std::string incomplete;                   // why there are no pixels, empty where there are
};

// Frames come and settings are in force: its clock and its count begin anew.
struct CameraFound {
  std::string description;
  CameraSettings settings;              // in force; the laser is off
  std::int64_t shortest_period_us = 0;  // between the starts of two exposures
  bool wired_laser = false;             // the laser cannot be switched: it is taken to be on
};

// No frames until it is found again.
struct CameraLost {
  std::string reason;  // one line: what, where, what to do
};

// The camera has answered a request. Nothing is sure between the request and this.
struct SettingsApplied {
  std::int64_t ticket = 0;
  CameraSettings settings;              // as the camera reads them back
  std::int64_t acknowledged_utime = 0;  // exposures that begin later have them; us, UTC
  std::string error;                    // why they were not applied, empty where they were
};

using SourceEvent = std::variant<Frame, CameraFound, CameraLost, SettingsApplied>;

struct SourceCounts {
  std::int64_t frames = 0;      // begun, the incomplete ones included
  std::int64_t incomplete = 0;  // of those, without their pixels
  std::int64_t lost = 0;        // never begun at the host, by the gaps in the camera's count
};

// Knows no LCM. Works in threads of its own; what it has to say waits in order until it is polled.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  virtual void start() = 0;

  // Turns the laser off and lets the device go; returns when that is done.
  virtual void stop() = 0;

  // Asks for settings; the answer is a SettingsApplied with this ticket. Returns at once.
  virtual void request(std::int64_t ticket, const CameraSettings& settings) = 0;

  // What happened next, nothing where nothing waits.
  virtual std::optional<SourceEvent> poll() = 0;

  virtual SourceCounts counts() const = 0;
};

}  // namespace arcstart::sensor_capture
