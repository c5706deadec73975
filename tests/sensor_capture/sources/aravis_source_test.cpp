// The whole way through Aravis, GigE Vision packets on loopback included.
#include "services/sensor_capture/sources/aravis_source.hpp"

#include <catch2/catch.hpp>
#include <memory>

#include "common/time.hpp"
#include "tests/sensor_capture/support/fake_camera.hpp"

using namespace arcstart;
using namespace arcstart::sensor_capture;
using namespace arcstart::test;

namespace {

// Waits for what the source says.
struct Watch {
  std::mutex mutex;
  std::condition_variable something;
  bool woken = false;
  AravisSource source;

  explicit Watch(const SensorCaptureSettings& settings = settings_of_test())
      : source(settings, [this] {
          const std::lock_guard lock(mutex);
          woken = true;
          something.notify_all();
        }) {
    source.start();
  }
  SourceEvent next() {
    while (true) {
      if (auto event = source.poll()) return std::move(*event);
      std::unique_lock lock(mutex);
      REQUIRE(something.wait_for(lock, std::chrono::seconds(30), [this] { return woken; }));
      woken = false;
    }
  }
  // The next of one kind; others are passed over.
  template <class Event>
  Event next_of() {
    while (true) {
      SourceEvent event = next();
      if (auto* wanted = std::get_if<Event>(&event)) return std::move(*wanted);
    }
  }
  Frame next_complete() {
    while (true) {
      Frame frame = next_of<Frame>();
      if (frame.incomplete.empty()) return frame;
    }
  }
};

}  // namespace

TEST_CASE("aravis: frames, their region, numbers and stamps") {
  FakeCamera camera;
  SensorCaptureSettings settings = settings_of_test();
  settings.frame_rate_hz = 100;
  Watch watch(settings);
  const auto found = watch.next_of<CameraFound>();
  CHECK(found.description.find("ARC01") != std::string::npos);
  CHECK(found.description.find("127.0.0.1") != std::string::npos);
  CHECK(found.settings.exposure_us == 5'000);
  CHECK_FALSE(found.settings.laser_on);
  CHECK_FALSE(found.wired_laser);
  CHECK(found.shortest_period_us == Approx(9'500).margin(10));
  CHECK(camera.read(kLineSource) == kSourceOff);
  CHECK(camera.read(kLineMode) == 1);
  CHECK(camera.read(0x938) == 2000);  // heartbeat timeout, ms

  std::int64_t last_seq = -1, last_time = 0;
  // The fake's count starts shortly before its wrap from 65535 to 1.
  while (last_seq < 65'535 + 20) {
    const Frame frame = watch.next_complete();
    CHECK(frame.seq > last_seq);
    CHECK(frame.width == 160);
    CHECK(frame.height == 120);
    CHECK(frame.offset_u == 16);
    CHECK(frame.offset_v == 8);
    CHECK(frame.sensor_width == 320);
    CHECK(frame.sensor_height == 240);
    REQUIRE(frame.pixels.size() == 160 * 120);
    CHECK(grey(frame) == kDark);
    // The stamp is the camera's own; arrival is the host's time, after the exposure's beginning.
    CHECK(frame.device_time_ns == exposure_begin(frame) + FakeCamera::kClockAhead);
    CHECK(frame.device_time_ns > last_time);
    CHECK(frame.arrival_utime >= exposure_begin(frame) / 1000);
    CHECK(frame.arrival_utime <= utime_now());
    last_seq = frame.seq;
    last_time = frame.device_time_ns;
  }
  CHECK(watch.source.counts().frames + watch.source.counts().lost >= 65'535 + 20 - 65'402);
  CHECK(watch.source.counts().lost < 20);
  watch.source.stop();
  CHECK(camera.read(ARV_FAKE_CAMERA_REGISTER_ACQUISITION) == 0);
  CHECK(camera.read(0xa00) == 0);  // control is given back
}

TEST_CASE("aravis: the laser follows requests, frames after the answer show it") {
  FakeCamera camera;
  Watch watch;
  watch.next_of<CameraFound>();
  watch.next_complete();
  bool on = false;
  for (std::int64_t ticket = 1; ticket <= 6; ++ticket) {
    on = !on;
    watch.source.request(ticket, {5'000, 0, on});
    const auto applied = watch.next_of<SettingsApplied>();
    CHECK(applied.ticket == ticket);
    CHECK(applied.error == "");
    CHECK(applied.settings.laser_on == on);
    CHECK(camera.read(kLineSource) == (on ? kSourceExposureActive : kSourceOff));
    for (int i = 0; i < 3;) {
      const Frame frame = watch.next_complete();
      if (exposure_begin(frame) / 1000 < applied.acknowledged_utime) continue;
      CHECK(grey(frame) == (on ? kLit : kDark));
      ++i;
    }
  }
  watch.source.request(7, {5'000, 0, true});
  watch.next_of<SettingsApplied>();
  watch.source.stop();
  CHECK(camera.read(kLineSource) == kSourceOff);
}

TEST_CASE("aravis: exposure and gain, and what the camera cannot do") {
  FakeCamera camera;
  Watch watch;
  watch.next_of<CameraFound>();
  watch.source.request(1, {12'000, 3, false});
  const auto applied = watch.next_of<SettingsApplied>();
  CHECK(applied.error == "");
  CHECK(applied.settings.exposure_us == 12'000);
  CHECK(applied.settings.gain_db == 3);
  CHECK(camera.read(ARV_FAKE_CAMERA_REGISTER_EXPOSURE_TIME_US) == 12'000);
  CHECK(camera.read(ARV_FAKE_CAMERA_REGISTER_GAIN_RAW) == 3);

  watch.source.request(2, {1e9, 3, true});
  const auto refused = watch.next_of<SettingsApplied>();
  CHECK(refused.ticket == 2);
  CHECK(refused.error.find("exposure of 1000000000 us: camera Aravis-Fake-ARC01") == 0);
  CHECK(camera.read(ARV_FAKE_CAMERA_REGISTER_EXPOSURE_TIME_US) == 12'000);
  CHECK(camera.read(kLineSource) == kSourceOff);
  watch.next_complete();
}

TEST_CASE("aravis: the camera is absent, comes, goes and comes back") {
  Watch watch;
  CHECK(watch.next_of<CameraLost>().reason.find("no GigE Vision camera found: check its power") ==
        0);
  auto camera = std::make_unique<FakeCamera>();
  watch.next_of<CameraFound>();
  Frame last = watch.next_complete();
  watch.source.request(1, {5'000, 0, true});
  watch.next_of<SettingsApplied>();
  for (int i = 0; i < 5; ++i) last = watch.next_complete();

  camera.reset();  // it vanishes, lit
  while (true) {
    SourceEvent event = watch.next();
    if (auto* frame = std::get_if<Frame>(&event)) last = *frame;
    if (auto* lost = std::get_if<CameraLost>(&event)) {
      CHECK(lost->reason.find("camera Aravis-Fake-ARC01 at 127.0.0.1 is lost") == 0);
      break;
    }
  }
  camera = std::make_unique<FakeCamera>();  // its registers say lit, its count begins anew
  const auto found = watch.next_of<CameraFound>();
  CHECK_FALSE(found.settings.laser_on);
  CHECK(camera->read(kLineSource) == kSourceOff);
  const Frame back = watch.next_complete();
  CHECK(back.seq >= last.seq + 2);
  CHECK(grey(back) == kDark);
  watch.source.stop();
}

TEST_CASE("aravis: control taken away is noticed, and regained") {
  FakeCamera camera;
  Watch watch;
  watch.next_of<CameraFound>();
  const Frame before = watch.next_complete();
  camera.take_control_away();
  CHECK(watch.next_of<CameraLost>().reason.find("is lost") != std::string::npos);
  watch.next_of<CameraFound>();
  CHECK(watch.next_complete().seq > before.seq + 1);
}

TEST_CASE("aravis: lost packets give incomplete frames or gaps, both counted") {
  FakeCamera camera;
  Watch watch;
  watch.next_of<CameraFound>();
  watch.next_complete();
  camera.lose_packets(0.2);
  std::int64_t incomplete = 0, first = -1, last = -1, frames = 0;
  while (incomplete < 3) {
    const Frame frame = watch.next_of<Frame>();
    if (first < 0) first = frame.seq;
    CHECK(frame.seq > last);
    last = frame.seq;
    ++frames;
    if (frame.incomplete.empty()) continue;
    ++incomplete;
    CHECK(frame.pixels.empty());
    CHECK(frame.device_time_ns > 0);
    CHECK(frame.incomplete.find("packets") != std::string::npos);
  }
  const SourceCounts counts = watch.source.counts();
  CHECK(counts.incomplete >= incomplete);
  CHECK(counts.frames >= frames);
  CHECK(counts.lost >= last - first + 1 - frames);
}

TEST_CASE("aravis: by serial number, by address, or not at all") {
  FakeCamera camera;
  SensorCaptureSettings settings = settings_of_test();
  settings.camera = GENERATE("ARC01", "127.0.0.1", "Aravis-Fake-ARC01");
  Watch watch(settings);
  watch.next_of<CameraFound>();
  settings.camera = "ARC02";
  Watch other(settings);
  CHECK(other.next_of<CameraLost>().reason.find("camera 'ARC02' not found") == 0);
}

TEST_CASE("aravis: a camera that another program holds") {
  FakeCamera camera;
  Watch first;
  first.next_of<CameraFound>();
  Watch second;
  CHECK(second.next_of<CameraLost>().reason.find("another program controls camera") == 0);
  first.next_complete();
  first.source.stop();
  second.next_of<CameraFound>();
}

TEST_CASE("aravis: a camera without a digital output needs a wired laser") {
  FakeCamera camera(false);
  SensorCaptureSettings settings = settings_of_test();
  SECTION("not said so") {
    Watch watch(settings);
    CHECK(watch.next_of<CameraLost>().reason.find("set sensor_capture.laser_line to ''") !=
          std::string::npos);
  }
  SECTION("said so") {
    settings.laser_line = "";
    Watch watch(settings);
    CHECK(watch.next_of<CameraFound>().wired_laser);
    watch.source.request(1, {5'000, 0, true});
    CHECK(watch.next_of<SettingsApplied>().settings.laser_on);
  }
}

TEST_CASE("aravis: a region outside the sensor is said so") {
  FakeCamera camera;
  SensorCaptureSettings settings = settings_of_test();
  settings.region_offset_u_px = 200;
  Watch watch(settings);
  CHECK(watch.next_of<CameraLost>().reason.find("does not lie on its sensor of 320 x 240") !=
        std::string::npos);
}
