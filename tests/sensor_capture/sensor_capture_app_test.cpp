// The app on an in-memory bus, its camera a script whose clock is ahead of the host's by a known
// amount.
#include "services/sensor_capture/sensor_capture_app.hpp"

#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "common/time.hpp"

using namespace arcstart;

namespace {

constexpr std::int64_t kDeviceAhead = 5'000'000'000;  // us
constexpr std::int64_t kExposure = 4'000;             // us
constexpr std::int64_t ms = 1000;

struct Script {
  std::deque<SourceEvent> events;
  std::vector<std::pair<std::int64_t, CameraSettings>> requests;
  bool stopped = false;
  SourceCounts counts;
};

struct ScriptedSource : FrameSource {
  Script& script;
  explicit ScriptedSource(Script& s) : script(s) {}
  void start() override {}
  void stop() override { script.stopped = true; }
  void request(std::int64_t ticket, const CameraSettings& settings) override {
    script.requests.push_back({ticket, settings});
  }
  std::optional<SourceEvent> poll() override {
    if (script.events.empty()) return std::nullopt;
    auto event = script.events.front();
    script.events.pop_front();
    return event;
  }
  SourceCounts counts() const override { return script.counts; }
};

struct Cell {
  std::unique_ptr<Bus> bus = Bus::in_memory();
  Script script;
  SensorCaptureSettings settings;
  std::vector<image_t> images, previews;
  std::vector<scan_t> scans;
  std::vector<std::string> order;  // of channels
  std::unique_ptr<SensorCaptureApp> app;
  std::size_t answered = 0;
  std::int64_t seq = 100;

  explicit Cell(SensorCaptureSettings given = {}) : settings(given) {
    settings.exposure_us = kExposure;
    settings.settle_margin_ms = 2;
    const auto keep = [this](auto& list, const char* name) {
      return [this, &list, name](const auto& message) {
        list.push_back(message);
        order.push_back(name);
      };
    };
    bus->subscribe<image_t>("LASER0_IMAGE", Queue::images(), keep(images, "image"));
    bus->subscribe<image_t>("LASER0_PREVIEW", Queue::images(), keep(previews, "preview"));
    bus->subscribe<scan_t>("LASER0_SCAN", Queue::measurements(), keep(scans, "scan"));
    app = std::make_unique<SensorCaptureApp>(*bus, settings, Instance{}, 55,
                                             std::make_unique<ScriptedSource>(script));
  }
  void step() {
    app->tick(utime_now());
    while (bus->handle(std::chrono::milliseconds(0))) app->tick(utime_now());
  }
  void find_camera() {
    CameraFound found;
    found.description = "a script";
    found.settings = {kExposure, 0, false};
    script.events.push_back(found);
    step();
    answer();
  }
  // The camera does at once what was asked last.
  void answer() {
    for (; answered < script.requests.size(); ++answered)
      script.events.push_back(SettingsApplied{
          script.requests[answered].first, script.requests[answered].second, utime_now(), {}});
    step();
  }
  // A frame exposed now; it arrives as its exposure begins.
  Frame make_frame() {
    Frame frame;
    frame.seq = ++seq;
    frame.width = 8;
    frame.height = 4;
    frame.offset_u = 16;
    frame.offset_v = 2;
    frame.sensor_width = 40;
    frame.sensor_height = 30;
    frame.arrival_utime = utime_now();
    frame.device_time_ns = (frame.arrival_utime + kDeviceAhead) * 1000 + 321;
    frame.pixels.assign(32, static_cast<std::uint8_t>(seq));
    return frame;
  }
  void expose() {
    script.events.push_back(make_frame());
    step();
    std::this_thread::sleep_for(std::chrono::milliseconds(8));
  }
  void settle() { std::this_thread::sleep_for(std::chrono::milliseconds(6)); }
  void scan_command(std::int64_t id, std::int8_t action, double longest_s = 60) {
    scan_command_t command{};
    command.utime = utime_now();
    command.command_id = id;
    command.action = action;
    command.kind = scan_t::WORKPIECE;
    command.longest_duration = longest_s;
    bus->publish("LASER0_SCAN_COMMAND", command);
    while (bus->handle(std::chrono::milliseconds(0))) {
    }
    step();
  }
  void camera_command(std::int64_t id, std::int32_t wanted, std::int8_t laser,
                      double exposure_us = 0, double gain_db = -1) {
    camera_command_t command{};
    command.utime = utime_now();
    command.command_id = id;
    command.images = wanted;
    command.laser = laser;
    command.exposure_us = exposure_us;
    command.gain_db = gain_db;
    bus->publish("LASER0_CAMERA_COMMAND", command);
    while (bus->handle(std::chrono::milliseconds(0))) {
    }
    step();
  }
  bool laser_asked() const { return script.requests.back().second.laser_on; }
};

}  // namespace

TEST_CASE("sensor_capture: without a scan there is a preview and the scan's state, no image") {
  Cell cell;
  cell.find_camera();
  const std::int64_t begin = steady_now();
  for (int i = 0; i < 5; ++i) cell.expose();
  CHECK(cell.images.empty());
  REQUIRE_FALSE(cell.previews.empty());  // twice a second, however long this took
  CHECK(static_cast<std::int64_t>(cell.previews.size()) <= 1 + (steady_now() - begin) / 500'000);
  CHECK(cell.previews[0].width == 8);
  REQUIRE_FALSE(cell.scans.empty());
  CHECK(cell.scans.back().state == scan_t::IDLE);
  CHECK(cell.scans.back().run_id == 55);
  CHECK_FALSE(cell.laser_asked());
}

TEST_CASE("sensor_capture: a scan's images, their fields and its state") {
  Cell cell;
  cell.find_camera();
  cell.expose();
  cell.scan_command(7, scan_command_t::START);
  CHECK(cell.laser_asked());
  REQUIRE(cell.scans.back().state == scan_t::SCANNING);
  const std::int64_t scan_id = cell.scans.back().scan_id;
  cell.expose();  // the laser's switching is not answered: in no scan
  CHECK(cell.images.empty());
  cell.answer();
  cell.settle();
  for (int i = 0; i < 3; ++i) cell.expose();
  REQUIRE(cell.images.size() == 3);
  cell.scan_command(8, scan_command_t::STOP);
  CHECK_FALSE(cell.laser_asked());
  cell.expose();  // tells that no other is on its way
  REQUIRE(cell.scans.back().state == scan_t::ENDED);

  for (int i = 0; i < 3; ++i) {
    const image_t& image = cell.images[static_cast<std::size_t>(i)];
    CHECK(image.run_id == 55);
    CHECK(image.seq == 103 + i);
    CHECK(image.scan_id == scan_id);
    CHECK(image.scan_index == i);
    CHECK(image.width == 8);
    CHECK(image.height == 4);
    CHECK(image.offset_u == 16);
    CHECK(image.offset_v == 2);
    CHECK(image.sensor_width == 40);
    CHECK(image.sensor_height == 30);
    CHECK(image.exposure_us == kExposure);
    CHECK(image.gain_db == 0);
    CHECK(image.laser_on);
    CHECK(image.command_id == 0);
    CHECK(image.encoding == image_t::MONO8);
    CHECK(image.incomplete == "");
    CHECK(image.data == std::vector<std::uint8_t>(32, static_cast<std::uint8_t>(103 + i)));
    // The middle of the exposure. The clock's mapping stands still: the difference is the first
    // frame's, and here every frame arrives as it is stamped.
    CHECK(image.utime == image.device_time_ns / 1000 - kDeviceAhead + kExposure / 2);
    CHECK(image.arrival_utime == image.device_time_ns / 1000 - kDeviceAhead);
  }
  const scan_t& ended = cell.scans.back();
  CHECK(ended.scan_id == scan_id);
  CHECK(ended.begin_utime == scan_id);
  CHECK(ended.command_id == 8);
  CHECK(ended.kind == scan_t::WORKPIECE);
  CHECK(ended.first_seq == 103);
  CHECK(ended.last_seq == 105);
  CHECK(ended.images == 3);
  CHECK(ended.lost == 0);
  CHECK(ended.end_reason == "stop");
  CHECK(ended.end_utime > cell.images.back().utime);
  // The last image comes before the word that it was the last.
  const auto last_image = std::find(cell.order.rbegin(), cell.order.rend(), "image");
  const auto last_scan = std::find(cell.order.rbegin(), cell.order.rend(), "scan");
  CHECK(last_scan < last_image);
}

TEST_CASE("sensor_capture: the clock's mapping stands still while a scan runs") {
  Cell cell;
  cell.find_camera();
  Frame late = cell.make_frame();
  late.arrival_utime += 3'000;  // so far the shortest delay is 3 ms
  cell.script.events.push_back(late);
  cell.step();
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  cell.settle();
  cell.settle();
  cell.expose();
  cell.expose();
  REQUIRE_FALSE(cell.images.empty());
  for (const image_t& image : cell.images)
    CHECK(image.utime == image.device_time_ns / 1000 - kDeviceAhead + 3'000 + kExposure / 2);
}

TEST_CASE("sensor_capture: a start without a camera is refused, with why") {
  Cell cell;
  cell.script.events.push_back(CameraLost{"camera 10.0.0.2 is lost: no frame for 0.7 s"});
  cell.step();
  CHECK(cell.app->health().state == service_status_t::FAULT);
  CHECK(cell.app->health().last_error.find("10.0.0.2") != std::string::npos);
  cell.scan_command(7, scan_command_t::START);
  CHECK(cell.scans.back().state == scan_t::IDLE);
  CHECK(cell.scans.back().refused_command_id == 7);
  CHECK(cell.scans.back().refusal.find("10.0.0.2") != std::string::npos);
  CHECK(cell.script.requests.empty());
}

TEST_CASE("sensor_capture: a camera lost in a scan ends it; found again it is dark") {
  Cell cell;
  CHECK(cell.app->health().state == service_status_t::STARTING);
  cell.find_camera();
  CHECK(cell.app->health().state == service_status_t::RUNNING);
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  cell.settle();
  cell.expose();
  REQUIRE(cell.images.size() == 1);
  cell.script.events.push_back(CameraLost{"gone"});
  cell.step();
  CHECK(cell.scans.back().state == scan_t::ENDED);
  CHECK(cell.scans.back().end_reason == "camera lost");
  CHECK(cell.scans.back().last_seq == cell.images.back().seq);
  CHECK(cell.app->health().state == service_status_t::FAULT);
  const std::size_t requests = cell.script.requests.size();
  cell.step();
  CHECK(cell.script.requests.size() == requests);  // nobody is there to ask

  cell.find_camera();
  CHECK(cell.script.requests.size() == requests + 1);
  CHECK_FALSE(cell.laser_asked());
  CHECK(cell.app->health().state == service_status_t::RUNNING);
  cell.expose();
  CHECK(cell.images.size() == 1);
  CHECK(cell.scans.back().state == scan_t::ENDED);
  // Whatever it may have been asked before: a camera that is found is told to be dark.
  cell.script.events.push_back(CameraLost{"gone again"});
  cell.find_camera();
  CHECK(cell.script.requests.size() == requests + 2);
}

TEST_CASE("sensor_capture: incomplete frames go out without bytes, with the reason") {
  Cell cell;
  cell.find_camera();
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  cell.settle();
  cell.expose();
  Frame bad = cell.make_frame();
  bad.pixels.clear();
  bad.width = bad.height = bad.offset_u = bad.offset_v = 0;
  bad.incomplete = "packets are missing";
  cell.script.events.push_back(bad);
  cell.step();
  REQUIRE(cell.images.size() == 2);
  CHECK(cell.images[1].incomplete == "packets are missing");
  CHECK(cell.images[1].size == 0);
  CHECK(cell.images[1].scan_index == 1);
  CHECK(cell.scans.back().lost <= 1);
  cell.scan_command(8, scan_command_t::STOP);
  cell.settle();
  cell.expose();
  CHECK(cell.scans.back().lost == 1);
  CHECK(cell.scans.back().images == 2);
  CHECK(cell.app->health().received == 0);  // the source's own counts are told
  cell.script.counts = {10, 2, 3};
  CHECK(cell.app->health().received == 10);
  CHECK(cell.app->health().lost == 5);
}

TEST_CASE("sensor_capture: png carries the same pixels") {
  SensorCaptureSettings settings;
  settings.encoding = "png";
  Cell cell(settings);
  cell.find_camera();
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  cell.settle();
  cell.expose();
  REQUIRE(cell.images.size() == 1);
  CHECK(cell.images[0].encoding == image_t::PNG);
  const cv::Mat image = cv::imdecode(cell.images[0].data, cv::IMREAD_UNCHANGED);
  REQUIRE(image.type() == CV_8U);
  CHECK(image.cols == 8);
  CHECK(image.rows == 4);
  CHECK(cv::countNonZero(image != static_cast<int>(cell.images[0].seq)) == 0);
}

TEST_CASE("sensor_capture: a camera command's images, surely under its settings") {
  Cell cell;
  cell.find_camera();
  cell.expose();
  const Frame before = cell.make_frame();  // on its way when the command comes
  cell.settle();
  cell.camera_command(31, 2, camera_command_t::LASER_ON, 9'000, 6);
  cell.script.events.push_back(before);
  cell.step();
  CHECK(cell.images.empty());
  CHECK(cell.script.requests.back().second == CameraSettings{9'000, 6, true});
  cell.expose();
  CHECK(cell.images.empty());
  cell.answer();
  cell.settle();
  cell.expose();  // may still have the old exposure
  CHECK(cell.images.empty());
  cell.expose();
  cell.expose();
  REQUIRE(cell.images.size() == 2);
  for (const image_t& image : cell.images) {
    CHECK(image.command_id == 31);
    CHECK(image.scan_id == 0);
    CHECK(image.scan_index == -1);
    CHECK(image.exposure_us == 9'000);
    CHECK(image.gain_db == 6);
    CHECK(image.laser_on);
  }
  // Then as configured, and dark.
  CHECK(cell.script.requests.back().second == CameraSettings{kExposure, 0, false});
  cell.answer();
  for (int i = 0; i < 4; ++i) cell.expose();
  CHECK(cell.images.size() == 2);
  cell.camera_command(31, 2, camera_command_t::LASER_ON, 9'000, 6);  // repeated
  CHECK(cell.script.requests.back().second == CameraSettings{kExposure, 0, false});
}

TEST_CASE("sensor_capture: camera commands give way to scans, and are refused while they run") {
  Cell cell;
  cell.find_camera();
  cell.camera_command(31, 50, camera_command_t::LASER_OFF, 9'000);
  cell.scan_command(7, scan_command_t::START);
  CHECK(cell.script.requests.back().second == CameraSettings{kExposure, 0, true});
  cell.answer();
  cell.settle();
  cell.camera_command(32, 5, camera_command_t::LASER_OFF, 1'000);
  CHECK(cell.script.requests.back().second == CameraSettings{kExposure, 0, true});
  for (int i = 0; i < 4; ++i) cell.expose();
  // The first one is lit, but may still have the command's exposure.
  REQUIRE(cell.images.size() == 3);
  for (const image_t& image : cell.images) {
    CHECK(image.scan_id > 0);
    CHECK(image.exposure_us == kExposure);
  }
}

TEST_CASE("sensor_capture: settings that the camera cannot do end the command") {
  Cell cell;
  cell.find_camera();
  cell.camera_command(31, 1, camera_command_t::LASER_OFF, 500'000);
  cell.script.events.push_back(SettingsApplied{cell.script.requests.back().first,
                                               cell.script.requests.back().second, utime_now(),
                                               "exposure of 500000 us: at most 100000"});
  cell.answered = cell.script.requests.size();
  cell.step();
  CHECK(cell.app->health().state == service_status_t::DEGRADED);
  CHECK(cell.app->health().last_error.find("500000 us") != std::string::npos);
  cell.answer();
  for (int i = 0; i < 4; ++i) cell.expose();
  CHECK(cell.images.empty());
  CHECK(cell.script.requests.back().second == CameraSettings{kExposure, 0, false});
}

TEST_CASE("sensor_capture: a laser that is wired to the camera counts as lit") {
  Cell cell;
  CameraFound found;
  found.settings = {kExposure, 0, false};
  found.wired_laser = true;
  cell.script.events.push_back(found);
  cell.step();
  cell.answer();
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  cell.settle();
  cell.expose();
  REQUIRE(cell.images.size() == 1);
  CHECK(cell.images[0].laser_on);
}

TEST_CASE("sensor_capture: the robot's standing still ends a scan where so configured") {
  SensorCaptureSettings settings;
  settings.end_when_still = true;
  settings.still_duration_s = 0.1;
  Cell cell(settings);
  cell.find_camera();
  cell.scan_command(7, scan_command_t::START);
  cell.answer();
  const std::int64_t begin = cell.scans.back().scan_id;
  const auto publish = [&](std::int64_t utime, double x, const char* invalid) {
    robot_pose_t pose{};
    pose.utime = utime;
    pose.run_id = 1;
    pose.position[0] = x;
    pose.quaternion[0] = 1;
    pose.invalid = invalid;
    cell.bus->publish("ROBOT0_POSE", pose);
  };
  for (int i = 0; i < 10; ++i) publish(begin + 10 * ms * (i + 1), 10.0 * i, "clock");
  for (int i = 0; i < 30; ++i) publish(begin + 10 * ms * (i + 1), 0, "");
  cell.step();
  CHECK(cell.laser_asked());
  for (int i = 30; i < 42; ++i) publish(begin + 10 * ms * (i + 1), 5, "");
  cell.step();
  CHECK_FALSE(cell.laser_asked());
}

TEST_CASE(
    "sensor_capture: the state is repeated 5 times a second; the camera is let go at the end") {
  Cell cell;
  cell.find_camera();
  const std::size_t before = cell.scans.size();
  const std::int64_t begin = steady_now();
  while (steady_now() - begin < 1'000'000) {
    cell.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const auto told = static_cast<std::int64_t>(cell.scans.size() - before);
  CHECK(told >= 1);
  CHECK(told <= 1 + (steady_now() - begin) / 200'000);
  CHECK_FALSE(cell.script.stopped);
  cell.app.reset();
  CHECK(cell.script.stopped);
}
