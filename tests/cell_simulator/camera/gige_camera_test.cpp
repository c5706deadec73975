// In a network of its own: the camera's control port is fixed.
#include "services/cell_simulator/camera/gige_camera.hpp"

#include <array>
#include <atomic>
#include <catch2/catch.hpp>

#include "tests/cell_simulator/camera/running_camera.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

TEST_CASE("the features that a client sets read back, and reach the exposure") {
  RunningCamera running;
  CameraClient client;
  ArvCamera* camera = client.get();
  REQUIRE(camera);
  CHECK(std::string(arv_camera_get_device_serial_number(camera, nullptr)) == "TEST1");
  int width = 0, height = 0;
  arv_camera_get_sensor_size(camera, &width, &height, nullptr);
  CHECK(width == 320);
  CHECK(height == 240);

  arv_camera_set_exposure_time(camera, 3456, nullptr);
  arv_camera_set_gain(camera, 6.25, nullptr);
  arv_camera_set_frame_rate(camera, 20, nullptr);
  CHECK(arv_camera_get_exposure_time(camera, nullptr) == 3456);
  CHECK(arv_camera_get_gain(camera, nullptr) == Approx(6.25));
  CHECK(arv_camera_get_frame_rate(camera, nullptr) == Approx(20).epsilon(1e-4));
  CHECK(running.camera.frame_period() == 50'000);
  CHECK(arv_camera_get_pixel_format(camera, nullptr) == ARV_PIXEL_FORMAT_MONO_8);

  client.start();
  const SimulatedFrame frame = painted(client.next());
  CHECK(frame.exposure.exposure_us == 3456);
  CHECK(frame.exposure.gain_db == Approx(6.25));
  CHECK(frame.region.width == 320);
}

TEST_CASE(
    "stamps are the true begin of the exposure on the camera's clock, the image comes its delay "
    "later") {
  const GigeCameraSettings settings = small_camera();
  RunningCamera running(settings);
  CameraClient client;
  REQUIRE(client.get());
  client.start();
  std::uint64_t last_id = client.next().id;
  std::int64_t last_start = 0;
  for (int i = 0; i < 25; ++i) {
    const ReceivedFrame received = client.next();
    const SimulatedFrame frame = painted(received);
    CHECK(received.device_ns == settings.clock.nanoseconds(frame.start));
    CHECK(received.arrival_utime - frame.start >=
          27'320 - seconds_to_us(settings.transport));  // never sooner
    CHECK(received.id == last_id % 65535 + 1);
    if (last_start) CHECK((frame.start - last_start) % 40'000 == 0);
    last_id = received.id;
    last_start = frame.start;
  }
  CHECK(running.camera.frames() >= 26);
}

TEST_CASE("a region of the sensor") {
  RunningCamera running;
  CameraClient client;
  REQUIRE(client.get());
  GError* error = nullptr;
  arv_camera_set_region(client.get(), 40, 30, 128, 96, &error);
  REQUIRE(error == nullptr);
  int x = 0, y = 0, width = 0, height = 0;
  arv_camera_get_region(client.get(), &x, &y, &width, &height, nullptr);
  CHECK((std::array{x, y, width, height}) == (std::array{40, 30, 128, 96}));
  CHECK(arv_camera_get_payload(client.get(), nullptr) == 128 * 96);
  client.start();
  const ReceivedFrame received = client.next();
  CHECK(received.offset_x == 40);
  CHECK(received.offset_y == 30);
  CHECK(received.width == 128);
  CHECK(received.height == 96);
  const ImageRegion region = painted(received).region;
  CHECK((std::array{region.offset_x, region.offset_y, region.width, region.height}) ==
        (std::array{40, 30, 128, 96}));
}

TEST_CASE("the laser follows its line") {
  const GigeCameraSettings settings = small_camera();
  RunningCamera running(settings);
  CameraClient client;
  REQUIRE(client.get());
  client.start();
  // The first frame whose exposure begins after what was set before it.
  const auto frame_after_now = [&] {
    const std::int64_t set = settings.clock.nanoseconds(utime_now());
    ReceivedFrame frame = client.next();
    while (frame.device_ns <= set) frame = client.next();
    return frame.grey.back();
  };
  CHECK(frame_after_now() == 10);
  CHECK_FALSE(running.camera.laser_on());

  client.light_the_laser();
  CHECK(running.camera.laser_on());
  CHECK(frame_after_now() == 200);
  client.set("LineMode", "Input");
  CHECK(frame_after_now() == 10);
  client.set("LineMode", "Output");
  client.set("LineSource", "Off");
  CHECK(frame_after_now() == 10);

  client.set("LineSource", "UserOutput0");
  CHECK(frame_after_now() == 10);
  arv_camera_set_boolean(client.get(), "UserOutputValue", TRUE, nullptr);
  CHECK(frame_after_now() == 200);
  client.set("LineSource", "ExposureActive");
  CHECK(frame_after_now() == 200);
  client.stop();
  CHECK_FALSE(running.camera.laser_on());  // no exposure, no light
  client.set("LineSource", "UserOutput0");
  CHECK(running.camera.laser_on());  // latched: burns on
}

TEST_CASE("frames lost at the camera leave gaps in the id, and nothing else") {
  std::atomic<std::int64_t> count{0};
  RunningCamera running(small_camera(), [&](const SimulatedFrame&) { return ++count % 3 == 0; });
  CameraClient client;
  REQUIRE(client.get());
  client.start();
  std::uint64_t last = client.next().id;
  int gaps = 0;
  for (int i = 0; i < 12; ++i) {
    const std::uint64_t id = client.next().id;
    const std::uint64_t step = (id + 65535 - last) % 65535;
    CHECK((step == 1 || step == 2));
    if (step == 2) ++gaps;
    last = id;
  }
  CHECK(gaps >= 5);
  CHECK(gaps <= 7);
}

TEST_CASE("a camera that goes and comes again serves a new client") {
  RunningCamera running;
  {
    CameraClient client;
    REQUIRE(client.get());
    client.start();
    client.next();
    running.camera.close();
    CHECK_FALSE(running.camera.is_open());
    CHECK_FALSE(running.camera.laser_on());
  }
  CHECK_FALSE(CameraClient().get());
  running.camera.open();
  CameraClient client;
  REQUIRE(client.get());
  client.light_the_laser();
  client.start();
  CHECK(client.next().grey.back() == 200);
}

TEST_CASE(
    "a second camera at the same address, and an address that is none, are refused with what to "
    "do") {
  RunningCamera running;
  GigeCamera second(small_camera(), paint);
  CHECK_THROWS_WITH(second.open(),
                    Catch::Contains("127.0.0.1:3956") && Catch::Contains("another camera"));
  GigeCameraSettings elsewhere = small_camera();
  elsewhere.interface_address = "10.99.99.99";
  CHECK_THROWS_AS(GigeCamera(elsewhere, paint).open(), GigeCameraError);
  elsewhere.interface_address = "eth0";
  CHECK_THROWS_WITH(GigeCamera(elsewhere, paint).open(), Catch::Contains("camera_interface"));
}
