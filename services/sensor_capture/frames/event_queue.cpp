#include "services/sensor_capture/frames/event_queue.hpp"

#include <fmt/core.h>

namespace arcstart::sensor_capture {

void EventQueue::push(SourceEvent event) {
  {
    const std::lock_guard lock(mutex_);
    if (auto* frame = std::get_if<Frame>(&event)) {
      if (!frame->pixels.empty() && frames_waiting_ >= most_frames_) {
        frame->pixels = {};
        frame->incomplete =
            fmt::format("this host was too slow: {} frames waited already", most_frames_);
      }
      ++counts_.frames;
      if (!frame->incomplete.empty()) ++counts_.incomplete;
      if (last_seq_ >= 0) counts_.lost += frame->seq - last_seq_ - 1;
      last_seq_ = frame->seq;
      if (!frame->pixels.empty()) ++frames_waiting_;
    }
    waiting_.push_back(std::move(event));
  }
  notify_();
}

std::optional<SourceEvent> EventQueue::pop() {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty()) return std::nullopt;
  SourceEvent event = std::move(waiting_.front());
  waiting_.pop_front();
  if (const auto* frame = std::get_if<Frame>(&event); frame && !frame->pixels.empty())
    --frames_waiting_;
  return event;
}

SourceCounts EventQueue::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace arcstart::sensor_capture
