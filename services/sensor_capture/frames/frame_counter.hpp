// The camera's own count of frames, made one that rises for the whole run.
#pragma once

#include <cstdint>
#include <optional>

namespace arcstart::sensor_capture {

// GigE Vision counts frames from 1 to 65535 and then from 1 again (0 is never used), or, with
// extended ids, in 64 bits without a wrap.
class FrameCounter {
 public:
  // The run's number of the frame with this id. A lost frame leaves a gap; so does a restart(), or
  // a count that goes back.
  std::int64_t number(std::uint64_t frame_id);

  // The camera went and came back: its count begins anew.
  void restart() { last_id_.reset(); }

 private:
  std::optional<std::uint64_t> last_id_;
  std::int64_t last_number_ = -1;
};

}  // namespace arcstart::sensor_capture
