#include "services/cell_simulator/camera/frame_renderer.hpp"

#include <algorithm>
#include <chrono>

#include "common/time.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::int64_t kShortest = 500;      // rest between two looks; us
constexpr std::int64_t kLookAgain = 10'000;  // while the camera stands; us
constexpr std::int64_t kLateCamera =
    30'000;  // a frame not asked for so long after its slot is given up; us

bool same_region(const ImageRegion& a, const ImageRegion& b) {
  return a.offset_x == b.offset_x && a.offset_y == b.offset_y && a.width == b.width &&
         a.height == b.height;
}

bool same(const SimulatedFrame& a, const SimulatedFrame& b) {
  return a.slot == b.slot && a.start == b.start &&
         a.exposure.exposure_us == b.exposure.exposure_us &&
         a.exposure.gain_db == b.exposure.gain_db && a.exposure.laser_on == b.exposure.laser_on &&
         same_region(a.region, b.region);
}

}  // namespace

FrameRenderer::FrameRenderer(Render render, Upcoming upcoming)
    : render_(std::move(render)), upcoming_(std::move(upcoming)), thread_([this] { run(); }) {}

FrameRenderer::~FrameRenderer() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

SimulatedFrame FrameRenderer::take(const SimulatedFrame& wanted, std::uint8_t* grey) {
  const std::lock_guard lock(mutex_);
  if (!ready_ || ready_->slot != wanted.slot || !same_region(ready_->region, wanted.region))
    render(wanted);
  std::copy(grey_.begin(), grey_.end(), grey);
  taken_slot_ = wanted.slot;
  changed_.notify_all();
  return *ready_;
}

void FrameRenderer::discard() {
  const std::lock_guard lock(mutex_);
  ready_.reset();
  changed_.notify_all();
}

void FrameRenderer::render(const SimulatedFrame& frame) {
  grey_.resize(static_cast<std::size_t>(frame.region.width) *
               static_cast<std::size_t>(frame.region.height));
  render_(frame, grey_.data());
  ready_ = frame;
}

void FrameRenderer::wait_until(std::unique_lock<std::mutex>& lock, std::int64_t utime) {
  changed_.wait_for(lock, std::chrono::microseconds(std::max(utime - utime_now(), kShortest)));
}

void FrameRenderer::run() {
  std::unique_lock lock(mutex_);
  while (!ending_) {
    const std::int64_t now = utime_now();
    const bool waits_for_camera =
        ready_ && ready_->slot != taken_slot_ && ready_->slot + kLateCamera > now;
    if (waits_for_camera && ready_->slot <= now) {
      wait_until(lock, ready_->slot + kLateCamera);
      continue;
    }
    const std::optional<SimulatedFrame> next = upcoming_(now);
    if (!next) {
      ready_.reset();
      wait_until(lock, now + kLookAgain);
      continue;
    }
    // What the client sets until the exposure begins still holds for it.
    const bool final = ready_ && ready_->slot == next->slot && next->slot == begun_slot_;
    if (!final && (!ready_ || !same(*ready_, *next))) render(*next);
    if (now >= next->start) begun_slot_ = next->slot;
    wait_until(lock, now >= next->start ? next->slot : next->start);
  }
}

}  // namespace arcstart::cell_simulator
