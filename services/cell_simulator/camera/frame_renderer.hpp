// Renders the camera's next frame before the camera needs it, on a thread of its own.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "services/cell_simulator/image/image_renderer.hpp"

namespace arcstart::cell_simulator {

// One exposure. Times in us, UTC.
struct SimulatedFrame {
  std::int64_t slot = 0;   // when the camera asks for its bytes, on the frame clock
  std::int64_t start = 0;  // true begin of the exposure
  Exposure exposure;
  ImageRegion region;

  std::int64_t middle() const {
    return start + static_cast<std::int64_t>(exposure.exposure_us / 2);
  }
};

class FrameRenderer {
 public:
  using Render = std::function<void(const SimulatedFrame&, std::uint8_t* grey)>;
  using Upcoming = std::function<std::optional<SimulatedFrame>(std::int64_t now)>;

  // upcoming: the next frame due after a time, as the camera is set then; nothing while it stands.
  // Both are called one at a time, from the own thread and from take()'s, and must live as long as
  // this.
  FrameRenderer(Render render, Upcoming upcoming);
  ~FrameRenderer();
  FrameRenderer(const FrameRenderer&) = delete;
  FrameRenderer& operator=(const FrameRenderer&) = delete;

  // Copies the frame of that slot to `grey` and returns what was exposed: as the camera was set
  // when its exposure began. Renders it now where it is not ready.
  SimulatedFrame take(const SimulatedFrame& wanted, std::uint8_t* grey);

  // The scene has changed: what is ready is rendered anew.
  void discard();

 private:
  void run();
  void render(const SimulatedFrame& frame);
  void wait_until(std::unique_lock<std::mutex>& lock, std::int64_t utime);

  Render render_;
  Upcoming upcoming_;
  std::mutex mutex_;  // held while rendering: the renderer serves one thread at a time
  std::condition_variable changed_;
  bool ending_ = false;
  std::optional<SimulatedFrame> ready_;
  std::vector<std::uint8_t> grey_;  // of ready_
  std::int64_t taken_slot_ = 0;
  std::int64_t begun_slot_ = 0;  // its exposure has begun: its settings are final
  std::thread thread_;
};

}  // namespace arcstart::cell_simulator
