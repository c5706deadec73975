#include "services/sensor_capture/frames/frame_counter.hpp"

namespace arcstart::sensor_capture {
namespace {

constexpr std::uint64_t kLargestShortId = 65535;

// How many frames further, 0 or less for back.
std::int64_t steps(std::uint64_t from, std::uint64_t to) {
  if (from > kLargestShortId || to > kLargestShortId || to > from)
    return static_cast<std::int64_t>(to - from);
  // 1 follows 65535. More than half a round ahead is behind.
  const auto ahead = static_cast<std::int64_t>(to + kLargestShortId - from);
  return ahead <= static_cast<std::int64_t>(kLargestShortId / 2) ? ahead : 0;
}

}  // namespace

std::int64_t FrameCounter::number(std::uint64_t frame_id) {
  if (!last_id_ && last_number_ < 0) {
    last_number_ = static_cast<std::int64_t>(frame_id);
  } else {
    const std::int64_t ahead = last_id_ ? steps(*last_id_, frame_id) : 0;
    last_number_ += ahead > 0 ? ahead : 2;
  }
  last_id_ = frame_id;
  return last_number_;
}

}  // namespace arcstart::sensor_capture
