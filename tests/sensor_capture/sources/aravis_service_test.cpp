// The whole service with a camera on loopback, on an in-memory bus.
#include <catch2/catch.hpp>
#include <memory>

#include "common/time.hpp"
#include "services/sensor_capture/sensor_capture_app.hpp"
#include "services/sensor_capture/sources/aravis_source.hpp"
#include "tests/sensor_capture/support/fake_camera.hpp"

using namespace arcstart;
using namespace arcstart::sensor_capture;
using namespace arcstart::test;

namespace {

// The service's app with a real camera source, on an in-memory bus.
struct Service {
  std::unique_ptr<Bus> bus = Bus::in_memory();
  std::vector<image_t> images;  // but for those that only tell a scan's end
  scan_t scan{};
  std::unique_ptr<SensorCaptureApp> app;

  Service() {
    bus->subscribe<image_t>("LASER0_IMAGE", Queue::images(), [this](const image_t& m) {
      if (m.scan_id != 0 || m.command_id != 0) images.push_back(m);
    });
    bus->subscribe<scan_t>("LASER0_SCAN", Queue::measurements(),
                           [this](const scan_t& m) { scan = m; });
    const auto settings = settings_of_test();
    app = std::make_unique<SensorCaptureApp>(*bus, settings, Instance{}, 1,
                                             std::make_unique<AravisSource>(settings, [] {}));
  }
  void run_until(const std::function<bool()>& done) {
    const std::int64_t begin = steady_now();
    while (!done()) {
      REQUIRE(steady_now() - begin < 30'000'000);
      app->tick(utime_now());
      bus->handle(std::chrono::milliseconds(2));
    }
  }
  void command(std::int64_t id, std::int8_t action) {
    scan_command_t message{};
    message.utime = utime_now();
    message.command_id = id;
    message.action = action;
    message.longest_duration = 60;
    bus->publish("LASER0_SCAN_COMMAND", message);
  }
};

}  // namespace

TEST_CASE("aravis: a scan of the whole service is lit, dark before and after") {
  FakeCamera camera;
  Service service;
  service.run_until([&] { return service.app->health().state == service_status_t::RUNNING; });
  service.run_until([&] { return camera.frames >= 3; });
  service.command(1, scan_command_t::START);
  service.run_until([&] { return service.images.size() >= 12; });
  service.command(2, scan_command_t::STOP);
  service.run_until([&] { return service.scan.state == scan_t::ENDED; });
  const std::size_t count = service.images.size();
  const int frames = camera.frames;
  service.run_until([&] { return camera.frames >= frames + 4; });

  CHECK(service.images.size() == count);
  CHECK(camera.read(kLineSource) == kSourceOff);
  CHECK(service.scan.images == static_cast<std::int32_t>(count));
  CHECK(service.scan.last_seq == service.images.back().seq);
  CHECK(service.scan.first_seq == service.images.front().seq);
  CHECK(service.scan.end_cause == scan_t::STOP);
  for (std::size_t i = 0; i < count; ++i) {
    const image_t& image = service.images[i];
    CHECK(image.scan_index == static_cast<std::int32_t>(i));
    CHECK(image.laser_on);
    if (!image.incomplete.empty()) continue;
    REQUIRE(image.data.size() == 160 * 120);
    CHECK(image.data.back() == kLit);
    std::int64_t begin;
    std::memcpy(&begin, image.data.data(), sizeof begin);
    CHECK(begin / 1000 >= service.scan.begin_utime);
    // Half an exposure later, and never before it; the delay of the first packet is what is left.
    CHECK(image.utime - begin / 1000 >= 2'500);
    CHECK(image.utime - begin / 1000 < 2'500 + 100'000);
  }
}

TEST_CASE("aravis: a camera that vanishes in a scan ends it") {
  auto camera = std::make_unique<FakeCamera>();
  Service service;
  service.run_until([&] { return service.app->health().state == service_status_t::RUNNING; });
  service.command(1, scan_command_t::START);
  service.run_until([&] { return service.images.size() >= 3; });
  camera.reset();
  service.run_until([&] { return service.scan.state == scan_t::ENDED; });
  CHECK(service.scan.end_cause == scan_t::CAMERA_LOST);
  CHECK(service.scan.last_seq == service.images.back().seq);
  CHECK(service.app->health().state == service_status_t::FAULT);
  camera = std::make_unique<FakeCamera>();
  service.run_until([&] { return service.app->health().state == service_status_t::RUNNING; });
  CHECK(service.scan.state == scan_t::ENDED);
  const std::size_t count = service.images.size();
  service.command(2, scan_command_t::START);
  service.run_until([&] { return service.images.size() > count; });
  CHECK(service.images.back().scan_index == 0);
  CHECK(service.images.back().seq > service.images[count - 1].seq + 1);
}
