// In a network of its own: the camera's control port is fixed.
#include "services/cell_simulator/gige_camera.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstring>
#include <thread>

#include "common/time.hpp"
#include "tests/cell_simulator/camera_client.hpp"

using namespace arcstart;

namespace {

GigeCameraSettings small_camera() {
  GigeCameraSettings settings;
  settings.serial = "TEST1";
  settings.width = 320;
  settings.height = 240;
  settings.frame_rate = 25;
  settings.clock = {utime_now(), 5'000'000'000'000, 40};
  return settings;
}

// Every frame carries in its first bytes what it was rendered from; the rest is its laser: 200 lit,
// 10 dark.
void paint(const Frame& frame, std::uint8_t* grey) {
  std::memset(
      grey, frame.exposure.laser_on ? 200 : 10,
      static_cast<std::size_t>(frame.region.width) * static_cast<std::size_t>(frame.region.height));
  std::memcpy(grey, &frame, sizeof frame);
}
Frame painted(const ReceivedFrame& received) {
  Frame frame;
  std::memcpy(&frame, received.grey.data(), sizeof frame);
  return frame;
}

// A camera whose tick runs beside the test, as the service's main loop does.
struct RunningCamera {
  GigeCamera camera;
  std::atomic<bool> ending{false};
  std::thread ticking;
  explicit RunningCamera(const GigeCameraSettings& settings = small_camera(),
                         GigeCamera::Lose lose = {})
      : camera(settings, paint, std::move(lose)) {
    camera.open();
    ticking = std::thread([this] {
      while (!ending) {
        camera.tick(utime_now());
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
  }
  ~RunningCamera() {
    ending = true;
    ticking.join();
  }
};

// A client that takes control, starts the stream and dies: it never sends a heartbeat.
void write_registers_and_die(
    std::initializer_list<std::pair<std::uint32_t, std::uint32_t>> registers) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(3956);
  std::uint16_t id = 1;
  for (const auto& [where, value] : registers) {
    std::uint8_t packet[16] = {0x42, 1, 0, 0x82,
                               0,    8, 0, static_cast<std::uint8_t>(id++)};  // WRITEREG_CMD
    const std::uint32_t body[2] = {htonl(where), htonl(value)};
    std::memcpy(packet + 8, body, 8);
    sendto(socket, packet, sizeof packet, 0, reinterpret_cast<sockaddr*>(&address), sizeof address);
    std::uint8_t answer[64];
    REQUIRE(recv(socket, answer, sizeof answer, 0) > 0);
  }
  close(socket);
}

template <class Condition>
void wait_for(Condition condition) {
  for (int i = 0; i < 3000 && !condition(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  REQUIRE(condition());
}

}  // namespace

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
  const Frame frame = painted(client.next());
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
    const Frame frame = painted(received);
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

TEST_CASE("a client that dies leaves the laser dark, and the next one finds a camera at rest") {
  RunningCamera running;
  // Heartbeat 0.5 s, control, stream to the discard port, line as output, ExposureActive,
  // acquisition.
  write_registers_and_die({{0xa00, 2},
                           {0x938, 500},
                           {0xd00, 9},
                           {0xd04, 8192},
                           {0xd18, 0x7f000001},
                           {0xa004, 1},
                           {0xa008, 1},
                           {0x124, 1}});
  CHECK(running.camera.laser_on());
  wait_for([&] { return !running.camera.laser_on(); });
  const std::int64_t frames = running.camera.frames();

  CameraClient client;
  REQUIRE(client.get());
  CHECK(arv_camera_get_integer(client.get(), "GevHeartbeatTimeout", nullptr) == 500);
  client.light_the_laser();  // would show frames that go on for the dead client
  CHECK_FALSE(running.camera.laser_on());
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  CHECK(running.camera.frames() == frames);
  client.start();
  CHECK(client.next().grey.back() == 200);
}

TEST_CASE(
    "a client that takes over from a dead one at once gets its frames, and the laser is dark till "
    "then") {
  RunningCamera running;
  write_registers_and_die({{0xa00, 2},
                           {0x938, 500},
                           {0xd00, 9},
                           {0xd04, 8192},
                           {0xd18, 0x7f000001},
                           {0xa004, 1},
                           {0xa008, 1},
                           {0x124, 1}});
  wait_for([&] { return running.camera.frames() > 3; });
  // Its own packet may be the one by which the camera notices that the heartbeat is over.
  CameraClient client;
  for (int i = 0; i < 1000 && !client.get(); ++i) client.reconnect();
  REQUIRE(client.get());
  wait_for([&] { return !running.camera.laser_on(); });
  client.light_the_laser();
  client.start();
  for (int i = 0; i < 5; ++i) CHECK(client.next().grey.back() == 200);
}

TEST_CASE("a client may stop and start as often as it likes") {
  RunningCamera running;
  CameraClient client;
  REQUIRE(client.get());
  for (int i = 0; i < 20; ++i) {
    client.start();
    client.next();
    client.stop();
    CHECK_FALSE(running.camera.laser_on());
  }
}

TEST_CASE("frames lost at the camera leave gaps in the id, and nothing else") {
  std::atomic<std::int64_t> count{0};
  RunningCamera running(small_camera(), [&](const Frame&) { return ++count % 3 == 0; });
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
  CHECK_THROWS_AS(GigeCamera(elsewhere, paint).open(), CameraError);
  elsewhere.interface_address = "eth0";
  CHECK_THROWS_WITH(GigeCamera(elsewhere, paint).open(), Catch::Contains("camera_interface"));
}
