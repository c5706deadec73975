#include "services/cell_simulator/camera/frame_renderer.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "common/time.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

constexpr std::int64_t kSecond = 1'000'000;

SimulatedFrame frame_at(std::int64_t slot, std::int64_t start, double exposure_us) {
  SimulatedFrame frame;
  frame.slot = slot;
  frame.start = start;
  frame.exposure.exposure_us = exposure_us;
  frame.region = {0, 0, 4, 2};
  return frame;
}

// Writes the exposure time into every pixel and counts.
struct Painter {
  std::atomic<int> rendered{0};
  std::thread::id thread;
  FrameRenderer::Render render() {
    return [this](const SimulatedFrame& frame, std::uint8_t* grey) {
      std::fill_n(grey, frame.region.width * frame.region.height,
                  static_cast<std::uint8_t>(frame.exposure.exposure_us));
      thread = std::this_thread::get_id();
      ++rendered;
    };
  }
  void wait_for(int count) const {
    while (rendered < count) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
};

}  // namespace

TEST_CASE("a frame is rendered before it is asked for, once, on the own thread") {
  Painter painter;
  const SimulatedFrame coming = frame_at(utime_now() + 60 * kSecond, utime_now() + 59 * kSecond, 7);
  FrameRenderer renderer(painter.render(), [&](std::int64_t) { return coming; });
  painter.wait_for(1);
  std::vector<std::uint8_t> grey(8);
  const SimulatedFrame taken = renderer.take(coming, grey.data());
  CHECK(painter.rendered == 1);
  CHECK(painter.thread != std::this_thread::get_id());
  CHECK(taken.start == coming.start);
  CHECK(grey == std::vector<std::uint8_t>(8, 7));
}

TEST_CASE("a frame that nobody foresaw is rendered when it is asked for") {
  Painter painter;
  FrameRenderer renderer(painter.render(),
                         [](std::int64_t) { return std::optional<SimulatedFrame>(); });
  std::vector<std::uint8_t> grey(8);
  const SimulatedFrame taken = renderer.take(frame_at(5, 4, 9), grey.data());
  CHECK(painter.thread == std::this_thread::get_id());
  CHECK(taken.exposure.exposure_us == 9);
  CHECK(grey == std::vector<std::uint8_t>(8, 9));
}

TEST_CASE("what is set before the exposure begins holds for it, what is set later does not") {
  Painter painter;
  std::atomic<int> exposure{3};
  const std::int64_t start = utime_now() + kSecond / 2, slot = start + kSecond / 10;
  FrameRenderer renderer(painter.render(),
                         [&](std::int64_t) { return frame_at(slot, start, exposure); });
  painter.wait_for(1);
  exposure = 4;
  painter.wait_for(2);  // looked at again when the exposure begins
  CHECK(utime_now() >= start);
  exposure = 5;
  // The camera lets its slot pass, so that the renderer asks for what is due once more.
  while (utime_now() < slot + kSecond / 10)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::vector<std::uint8_t> grey(8);
  CHECK(renderer.take(frame_at(slot, start, 5), grey.data()).exposure.exposure_us == 4);
  CHECK(grey == std::vector<std::uint8_t>(8, 4));
}

TEST_CASE("a changed scene is rendered anew") {
  Painter painter;
  const SimulatedFrame coming = frame_at(utime_now() + 60 * kSecond, utime_now() + 59 * kSecond, 7);
  FrameRenderer renderer(painter.render(), [&](std::int64_t) { return coming; });
  painter.wait_for(1);
  renderer.discard();
  painter.wait_for(2);
  CHECK(painter.rendered == 2);
}

TEST_CASE("another region than the one foreseen is rendered when it is asked for") {
  Painter painter;
  const SimulatedFrame coming = frame_at(utime_now() + 60 * kSecond, utime_now() + 59 * kSecond, 7);
  FrameRenderer renderer(painter.render(), [&](std::int64_t) { return coming; });
  painter.wait_for(1);
  SimulatedFrame smaller = coming;
  smaller.region.width = 2;
  std::vector<std::uint8_t> grey(8, 0);
  renderer.take(smaller, grey.data());
  CHECK(grey == std::vector<std::uint8_t>{7, 7, 7, 7, 0, 0, 0, 0});
}
