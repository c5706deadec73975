// The real socket, on 127.0.0.1.
#include "services/robot_pose/j519/j519_source.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "tests/robot_pose/j519/j519_bytes.hpp"

using namespace arcstart;
using namespace arcstart::robot_pose;
using namespace arcstart::test;

namespace {

// The controller's end, at an address of the loopback network.
class DatagramPeer {
 public:
  explicit DatagramPeer(const char* address) {
    socket_ = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in here{};
    here.sin_family = AF_INET;
    inet_pton(AF_INET, address, &here.sin_addr);
    REQUIRE(bind(socket_, reinterpret_cast<sockaddr*>(&here), sizeof here) == 0);
    socklen_t size = sizeof here;
    getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &size);
    port = ntohs(here.sin_port);
  }
  ~DatagramPeer() { close(socket_); }
  // The next datagram within 20 s, while `work` goes on.
  std::vector<std::uint8_t> receive(const std::function<void()>& work) {
    for (int i = 0; i < 2000; ++i) {
      work();
      pollfd waiting{socket_, POLLIN, 0};
      if (poll(&waiting, 1, 10) != 1) continue;
      std::vector<std::uint8_t> bytes(1000);
      socklen_t size = sizeof client_;
      const ssize_t length = recvfrom(socket_, bytes.data(), bytes.size(), 0,
                                      reinterpret_cast<sockaddr*>(&client_), &size);
      bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
      return bytes;
    }
    return {};
  }
  void send(const std::vector<std::uint8_t>& bytes) { send_as(*this, bytes); }
  void send_as(DatagramPeer& other, const std::vector<std::uint8_t>& bytes) {
    sendto(other.socket_, bytes.data(), bytes.size(), 0,
           reinterpret_cast<const sockaddr*>(&client_), sizeof client_);
  }
  int port = 0;

 private:
  int socket_;
  sockaddr_in client_{};
};

}  // namespace

TEST_CASE("J519 source: question, start, positions, stop, all from the one port") {
  DatagramPeer controller("127.0.0.2"), stranger("127.0.0.3");
  RobotPoseSettings settings;
  settings.port = 0;
  settings.controller_address = "127.0.0.2";
  settings.controller_port = controller.port;
  std::optional<ReportedPosition> position;
  {
    J519Source source(settings, [] {});
    source.start();
    const auto tick = [&] {
      if (auto next = source.poll()) position = next;
    };
    CHECK(controller.receive(tick) ==
          from_hex("00000007 00000003 00000001 00000000 00000000 00000000 00000000"));
    controller.send_as(stranger, j519_capability(3, 1));
    controller.send(j519_capability(4, 1));
    CHECK(controller.receive(tick) == from_hex("000000c8 00000004"));
    controller.send(j519_status(4, 1, 1000));
    for (int i = 0; i < 2000 && !position; ++i) {
      tick();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    REQUIRE(position.has_value());
    CHECK(position->position == Eigen::Vector3d(985, 0, 940));
    CHECK(source.counts().foreign == 1);
    CHECK(source.last_error() == "packets of 127.0.0.3 are ignored, the controller is 127.0.0.2");
  }
  CHECK(controller.receive([] {}) == from_hex("00000002 00000004"));
}

TEST_CASE("J519 source: without addresses at which it can be heard it does not start") {
  J519Source source({}, [] {});
  CHECK_THROWS_WITH(source.start(), Catch::Contains("robot_pose.controller_address"));
  RobotPoseSettings settings;
  settings.controller_address = "192.0.2.7";
  J519Source deaf(settings, [] {});
  CHECK_THROWS_WITH(deaf.start(), Catch::Contains("robot_pose.address: 127.0.0.1 hears this host"));
}
