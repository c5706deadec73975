// What a source's thread has to say to the main loop, in order.
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <optional>

#include "services/sensor_capture/frames/frame_source.hpp"

namespace arcstart::sensor_capture {

constexpr std::size_t kMostFramesWaiting = 30;  // with pixels: two seconds at 15 frames a second

// Any thread may push and pop.
class EventQueue {
 public:
  // notify: called after each push, outside the lock; it must outlive this object.
  // most_frames: with pixels, that may wait; of further ones the pixels are dropped.
  EventQueue(std::function<void()> notify, std::size_t most_frames)
      : notify_(std::move(notify)), most_frames_(most_frames) {}

  void push(SourceEvent event);
  std::optional<SourceEvent> pop();
  SourceCounts counts() const;

 private:
  std::function<void()> notify_;
  std::size_t most_frames_;
  mutable std::mutex mutex_;
  std::deque<SourceEvent> waiting_;
  std::size_t frames_waiting_ = 0;
  std::int64_t last_seq_ = -1;
  SourceCounts counts_;
};

}  // namespace arcstart::sensor_capture
