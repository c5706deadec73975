// sensor_capture's app on an in-memory bus, its camera a script whose clock is ahead of the host's
// by a known amount.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/time.hpp"
#include "services/sensor_capture/sensor_capture_app.hpp"

namespace arcstart::test {

using namespace sensor_capture;

constexpr std::int64_t kDeviceAhead = 5'000'000'000;  // us
constexpr std::int64_t kScriptedExposure = 4'000;     // us

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

struct ScriptedCell {
  std::unique_ptr<Bus> bus = Bus::in_memory();
  Script script;
  SensorCaptureSettings settings;
  std::vector<image_t> images, previews;
  std::vector<image_t> ends;  // that only tell that a scan has ended
  std::vector<scan_t> scans;
  std::vector<std::string> order;  // of channels
  std::unique_ptr<SensorCaptureApp> app;
  std::size_t answered = 0;
  std::int64_t seq = 100;

  explicit ScriptedCell(SensorCaptureSettings given = {}) : settings(given) {
    settings.exposure_us = kScriptedExposure;
    settings.settle_margin_ms = 2;
    const auto keep = [this](auto& list, const char* name) {
      return [this, &list, name](const auto& message) {
        list.push_back(message);
        order.push_back(name);
      };
    };
    bus->subscribe<image_t>("LASER0_IMAGE", Queue::images(),
                            [keep_image = keep(images, "image"), this](const image_t& image) {
                              if (image.scan_id == 0 && image.command_id == 0)
                                return ends.push_back(image);
                              keep_image(image);
                            });
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
    found.settings = {kScriptedExposure, 0, false};
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
    command.request = 42;
    command.job = "job " + std::to_string(id);
    command.part = "part " + std::to_string(id);
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

}  // namespace arcstart::test
