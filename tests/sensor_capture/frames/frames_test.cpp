// Frame numbers, the queue of events and the preview.
#include <catch2/catch.hpp>
#include <random>
#include <thread>

#include "services/sensor_capture/frames/event_queue.hpp"
#include "services/sensor_capture/frames/frame_counter.hpp"
#include "services/sensor_capture/frames/preview.hpp"

using namespace arcstart;
using namespace arcstart::sensor_capture;

TEST_CASE("frame counter: 16 bit ids wrap from 65535 to 1") {
  FrameCounter counter;
  CHECK(counter.number(65'000) == 65'000);
  std::int64_t expected = 65'000;
  std::uint64_t id = 65'000;
  for (int i = 0; i < 200'000; ++i) {
    id = id == 65'535 ? 1 : id + 1;
    REQUIRE(counter.number(id) == ++expected);
  }
}

TEST_CASE("frame counter: lost frames leave their gap, across the wrap too") {
  FrameCounter counter;
  counter.number(65'533);
  CHECK(counter.number(65'535) == 65'535);
  CHECK(counter.number(3) == 65'538);  // 1 and 2 were lost
  CHECK(counter.number(4) == 65'539);
  CHECK(counter.number(104) == 65'639);
}

TEST_CASE("frame counter: extended ids do not wrap at 65535") {
  FrameCounter counter;
  counter.number(65'534);
  CHECK(counter.number(65'535) == 65'535);
  CHECK(counter.number(65'536) == 65'536);
  CHECK(counter.number(70'000) == 70'000);
}

TEST_CASE("frame counter: rises over a camera that begins anew, with a gap") {
  FrameCounter counter;
  counter.number(500);
  counter.restart();
  CHECK(counter.number(1) == 502);
  CHECK(counter.number(2) == 503);
  CHECK(counter.number(1) == 505);  // it went back by itself
  CHECK(counter.number(1) == 507);  // twice the same
}

namespace {

Frame frame(std::int64_t seq, std::size_t bytes = 4) {
  Frame f;
  f.seq = seq;
  f.pixels.resize(bytes);
  if (bytes == 0) f.incomplete = "cut";
  return f;
}

}  // namespace

TEST_CASE("event queue: order is kept, frames are counted") {
  int notified = 0;
  EventQueue queue([&] { ++notified; }, 100);
  queue.push(CameraFound{});
  queue.push(frame(10));
  queue.push(frame(11, 0));
  queue.push(frame(14));
  queue.push(CameraLost{"gone"});
  CHECK(notified == 5);
  CHECK(std::holds_alternative<CameraFound>(*queue.pop()));
  CHECK(std::get<Frame>(*queue.pop()).seq == 10);
  CHECK(std::get<Frame>(*queue.pop()).seq == 11);
  CHECK(std::get<Frame>(*queue.pop()).seq == 14);
  CHECK(std::get<CameraLost>(*queue.pop()).reason == "gone");
  CHECK_FALSE(queue.pop().has_value());
  CHECK(queue.counts().frames == 3);
  CHECK(queue.counts().incomplete == 1);
  CHECK(queue.counts().lost == 2);
}

TEST_CASE("event queue: too many frames lose their pixels, never their place") {
  EventQueue queue([] {}, 3);
  for (int i = 1; i <= 5; ++i) queue.push(frame(i));
  for (int i = 1; i <= 3; ++i) CHECK(std::get<Frame>(*queue.pop()).pixels.size() == 4);
  const Frame fourth = std::get<Frame>(*queue.pop());
  CHECK(fourth.seq == 4);
  CHECK(fourth.pixels.empty());
  CHECK(fourth.incomplete.find("too slow") != std::string::npos);
  queue.push(frame(6));  // there is room again
  queue.pop();
  CHECK(std::get<Frame>(*queue.pop()).pixels.size() == 4);
}

TEST_CASE("event queue: two threads lose nothing") {
  EventQueue queue([] {}, 1'000'000);
  std::thread other([&] {
    for (int i = 1; i <= 20'000; ++i) queue.push(frame(i, 1));
  });
  std::int64_t last = 0;
  while (last < 20'000)
    if (const auto event = queue.pop()) {
      REQUIRE(std::get<Frame>(*event).seq == last + 1);
      ++last;
    } else {
      std::this_thread::yield();
    }
  other.join();
}

TEST_CASE("preview: every pixel is the largest of its block") {
  std::mt19937 random(8);
  const int width = GENERATE(1, 37, 160), height = GENERATE(1, 23, 120);
  const int most = GENERATE(1, 50, 100'000);
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width * height));
  for (auto& pixel : pixels) pixel = static_cast<std::uint8_t>(random() % 256);
  const Preview preview = reduce_by_maximum(pixels, width, height, most);
  REQUIRE(preview.width * preview.height <= most);
  REQUIRE(preview.pixels.size() == static_cast<std::size_t>(preview.width * preview.height));
  const int block = std::max((width + preview.width - 1) / preview.width,
                             (height + preview.height - 1) / preview.height);
  if (most == 100'000) CHECK(preview.pixels == pixels);
  int largest = 0;
  for (const auto pixel : pixels) largest = std::max<int>(largest, pixel);
  if (most == 1)
    CHECK(preview.pixels == std::vector<std::uint8_t>{static_cast<std::uint8_t>(largest)});
  for (int v = 0; v < preview.height && most == 50; ++v)
    for (int u = 0; u < preview.width; ++u) {
      int expected = 0;
      for (int y = v * block; y < std::min((v + 1) * block, height); ++y)
        for (int x = u * block; x < std::min((u + 1) * block, width); ++x)
          expected = std::max<int>(expected, pixels[static_cast<std::size_t>(y * width + x)]);
      REQUIRE(preview.pixels[static_cast<std::size_t>(v * preview.width + u)] == expected);
    }
}

TEST_CASE("preview: a stripe of one pixel stays, in 50 KB") {
  std::vector<std::uint8_t> pixels(1600 * 1200, 4);
  for (int u = 0; u < 1600; ++u) pixels[static_cast<std::size_t>((300 + u / 4) * 1600 + u)] = 250;
  const Preview preview = reduce_by_maximum(pixels, 1600, 1200, 49'000);
  CHECK(preview.width * preview.height <= 49'000);
  CHECK(preview.width > 200);
  for (int u = 0; u < preview.width; ++u) {
    int brightest = 0;
    for (int v = 0; v < preview.height; ++v)
      brightest =
          std::max<int>(brightest, preview.pixels[static_cast<std::size_t>(v * preview.width + u)]);
    REQUIRE(brightest == 250);
  }
}
