// Which settings a frame was surely taken under.
#pragma once

#include <cstdint>
#include <deque>

#include "services/sensor_capture/frames/frame_source.hpp"

namespace arcstart::sensor_capture {

// A request takes effect at an unknown moment between its sending and some time after the camera
// has acknowledged it. Times in us, UTC; pure.
class SettingsTimeline {
 public:
  // margin_us: by how much a frame's begin must lie after the acknowledgement, so that an error of
  // the clocks' mapping cannot hide a change.
  // frames_to_settle: exposures begun after the acknowledgement that may still have the old
  // exposure time or gain (sensors latch them an exposure ahead). The laser switches at once.
  SettingsTimeline(std::int64_t margin_us, int frames_to_settle)
      : margin_us_(margin_us), frames_to_settle_(frames_to_settle) {}

  // The camera was found with these settings.
  void begin(const CameraSettings& settings);

  void requested(std::int64_t ticket, const CameraSettings& settings, std::int64_t utime);
  void applied(std::int64_t ticket, const CameraSettings& settings, std::int64_t utime);
  void refused(std::int64_t ticket);  // what was asked for is not in force

  struct InForce {
    CameraSettings settings;
    std::int64_t ticket = 0;  // of the request that they come from, 0 for those at begin()
    bool certain = true;      // throughout the exposure; else they may be a later request's
    bool lit = false;         // laser on throughout the exposure
  };
  // Of a frame whose exposure began then. Frames in order, each once.
  InForce take_frame(std::int64_t begin_utime);

  // The last ones asked for.
  const CameraSettings& wanted() const;

 private:
  struct Change {
    std::int64_t ticket;
    CameraSettings settings;
    std::int64_t requested;
    std::int64_t acknowledged = 0;  // 0: not yet
    int frames_after = 0;           // begun since then, the margin included
  };
  bool was_acknowledged(const Change& change, std::int64_t begin_utime) const;
  bool has_settled(const Change& change) const;

  std::int64_t margin_us_;
  int frames_to_settle_;
  CameraSettings settings_;
  std::int64_t ticket_ = 0;
  std::deque<Change> changes_;  // not yet settled, in order
};

}  // namespace arcstart::sensor_capture
