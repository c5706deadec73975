// In a network of its own: the camera's control port is fixed.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "tests/cell_simulator/camera/running_camera.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

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
