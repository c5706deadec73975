#include "services/sensor_capture/sources/folder_source.hpp"

#include <catch2/catch.hpp>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

using namespace arcstart;
using namespace arcstart::sensor_capture;
namespace fs = std::filesystem;

namespace {

// A folder of its own that goes with the test.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("arcstart_folder_" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string file(const std::string& name) const { return (path / name).string(); }
};

cv::Mat grey(int value) { return cv::Mat(6, 8, CV_8U, cv::Scalar(value)); }

// Waits for the source's events.
struct Player {
  std::mutex mutex;
  std::condition_variable something;
  bool woken = false;
  FolderSource source;

  explicit Player(const SensorCaptureSettings& settings)
      : source(settings, [this] {
          const std::lock_guard lock(mutex);
          woken = true;
          something.notify_all();
        }) {
    source.start();
  }
  SourceEvent next() {
    while (true) {
      if (auto event = source.poll()) return *event;
      std::unique_lock lock(mutex);
      REQUIRE(something.wait_for(lock, std::chrono::seconds(20), [this] { return woken; }));
      woken = false;
    }
  }
};

}  // namespace

TEST_CASE("folder: images by name, bad files as incomplete frames, stamps of an ideal camera") {
  Folder folder;
  cv::imwrite(folder.file("b.png"), grey(20));
  cv::imwrite(folder.file("a.pgm"), grey(10));
  cv::imwrite(folder.file("c.PNG"), cv::Mat(6, 8, CV_16U, cv::Scalar(1000)));
  std::ofstream(folder.file("d.png")) << "not a png";
  cv::imwrite(folder.file("e.png"), cv::Mat(6, 8, CV_8UC3, cv::Scalar(30, 30, 30)));
  cv::imwrite(folder.file("f.png"), cv::Mat(6, 8, CV_8UC3, cv::Scalar(30, 31, 30)));
  std::ofstream(folder.file("notes.txt")) << "no image";

  SensorCaptureSettings settings;
  settings.folder = folder.path.string();
  settings.frame_rate_hz = 200;
  settings.exposure_us = 1000;
  settings.folder_loops = false;
  Player player(settings);

  const auto found = std::get<CameraFound>(player.next());
  CHECK(found.settings == CameraSettings{1000, 0, false});
  CHECK(found.shortest_period_us == 4750);
  CHECK(found.description.find("6 images") == 0);
  std::vector<Frame> frames;
  for (int i = 0; i < 6; ++i) frames.push_back(std::get<Frame>(player.next()));
  const auto lost = std::get<CameraLost>(player.next());
  CHECK(lost.reason.find("have all been played") != std::string::npos);

  const int values[] = {10, 20, -1, -1, 30, -1};
  for (std::size_t i = 0; i < 6; ++i) {
    const Frame& frame = frames[i];
    CHECK(frame.seq == static_cast<std::int64_t>(i) + 1);
    CHECK(frame.device_time_ns == 1'000'000'000 + static_cast<std::int64_t>(i) * 5'000'000);
    CHECK(frame.pixels.empty() == (values[i] < 0));
    CHECK(frame.incomplete.empty() == (values[i] >= 0));
    if (values[i] < 0) continue;
    CHECK(frame.width == 8);
    CHECK(frame.sensor_height == 6);
    CHECK(frame.pixels == std::vector<std::uint8_t>(48, static_cast<std::uint8_t>(values[i])));
    // Never said to have arrived before its exposure's beginning.
    CHECK(frame.arrival_utime - frames[0].arrival_utime >=
          (frame.device_time_ns - frames[0].device_time_ns) / 1000 - 100'000);
  }
  CHECK(frames[2].incomplete.find("c.PNG: not of 8 bits") == 0);
  CHECK(frames[3].incomplete.find("d.png: not an image") == 0);
  CHECK(frames[5].incomplete.find("f.png: in colour") == 0);
  CHECK(player.source.counts().frames == 6);
  CHECK(player.source.counts().incomplete == 3);
}

TEST_CASE("folder: loops, and answers requests") {
  Folder folder;
  cv::imwrite(folder.file("a.png"), grey(10));
  cv::imwrite(folder.file("b.png"), grey(20));
  SensorCaptureSettings settings;
  settings.folder = folder.path.string();
  settings.frame_rate_hz = 500;
  Player player(settings);
  player.source.request(7, {3000, 1, true});
  bool answered = false;
  for (int frames = 0; frames < 7 || !answered;) {
    const SourceEvent event = player.next();
    if (const auto* frame = std::get_if<Frame>(&event)) {
      CHECK(frame->pixels[0] == (frames % 2 == 0 ? 10 : 20));
      CHECK(frame->seq == ++frames);
    } else if (const auto* applied = std::get_if<SettingsApplied>(&event)) {
      CHECK(applied->ticket == 7);
      CHECK(applied->settings.laser_on);
      CHECK(applied->acknowledged_utime > 0);
      answered = true;
    }
  }
  player.source.stop();
}

TEST_CASE("folder: absent or empty") {
  Folder folder;
  SensorCaptureSettings settings;
  settings.folder = GENERATE(true, false) ? folder.path.string() : "/no/such/folder";
  Player player(settings);
  const auto lost = std::get<CameraLost>(player.next());
  CHECK(lost.reason.find("no png or pgm image in '" + settings.folder + "'") == 0);
}
