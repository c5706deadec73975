// The real socket, on 127.0.0.1.
#include "services/robot_pose/hspo/hspo_source.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "common/time.hpp"
#include "tests/robot_pose/hspo/hspo_bytes.hpp"

using namespace arcstart;
using namespace arcstart::robot_pose;
using namespace arcstart::test;

namespace {

// Sends from an address of the loopback network to a port of 127.0.0.1.
class Sender {
 public:
  explicit Sender(int port, const char* from = "127.0.0.1") {
    socket_ = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    inet_pton(AF_INET, from, &address.sin_addr);
    REQUIRE(bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
    inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    REQUIRE(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  }
  ~Sender() { close(socket_); }
  void send(const std::vector<std::uint8_t>& bytes) {
    REQUIRE(::send(socket_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()));
  }

 private:
  int socket_;
};

RobotPoseSettings any_port() {
  RobotPoseSettings settings;
  settings.port = 0;
  return settings;
}

// Until so many datagrams have come, or 5 s.
void wait_for(const std::atomic<int>& notified, int count) {
  for (int i = 0; i < 500 && notified < count; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  REQUIRE(notified >= count);
}

}  // namespace

TEST_CASE("HSPO source: datagrams arrive with the kernel's time") {
  std::atomic<int> notified = 0;
  HspoSource source(any_port(), [&] { ++notified; });
  source.start();
  Sender sender(source.port());
  const std::int64_t before = utime_now();
  sender.send(tool_packet(1, 1000));
  sender.send({0x3c});
  sender.send(std::vector<std::uint8_t>(5000));
  wait_for(notified, 3);
  const std::int64_t after = utime_now();

  const auto position = source.poll();
  REQUIRE(position.has_value());
  CHECK(position->seq == 1);
  CHECK(position->arrival_utime >= before);
  CHECK(position->arrival_utime <= after);
  CHECK_FALSE(source.poll().has_value());
  CHECK(source.counts().received == 3);
  CHECK(source.counts().malformed == 2);
}

TEST_CASE("HSPO source: arrival is when the kernel took a datagram in, not when it was read") {
  std::atomic<int> notified = 0;
  std::atomic<bool> released = false;
  HspoSource source(any_port(), [&] {
    ++notified;
    while (!released) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  source.start();
  Sender sender(source.port());
  sender.send(tool_packet(1, 1000));
  wait_for(notified, 1);  // the reader is held up now
  sender.send(tool_packet(2, 21'000));
  const std::int64_t sent = utime_now();
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  released = true;
  wait_for(notified, 2);
  CHECK(source.poll()->arrival_utime <= sent);
  CHECK(source.poll()->arrival_utime <= sent);
}

TEST_CASE("HSPO source: a port that is taken is said so") {
  HspoSource first(any_port(), [] {});
  first.start();
  RobotPoseSettings settings;
  settings.port = first.port();
  HspoSource second(settings, [] {});
  CHECK_THROWS_WITH(second.start(), Catch::Contains("another program has this port") &&
                                        Catch::Contains(std::to_string(first.port())));
  settings.address = "192.0.2.1";  // of no host
  HspoSource third(settings, [] {});
  CHECK_THROWS_WITH(third.start(), Catch::Contains("192.0.2.1"));
}

TEST_CASE("HSPO source: one controller is heard, others are counted") {
  std::atomic<int> notified = 0;
  RobotPoseSettings settings = any_port();
  const bool set = GENERATE(true, false);
  if (set) settings.controller_address = "127.0.0.2";
  HspoSource source(settings, [&] { ++notified; });
  source.start();
  Sender controller(source.port(), "127.0.0.2"), other(source.port(), "127.0.0.3");
  if (set) other.send(tool_packet(900, 900));
  controller.send(tool_packet(1, 1000));
  other.send(tool_packet(901, 901));
  controller.send(tool_packet(2, 21'000));
  wait_for(notified, set ? 4 : 3);
  CHECK(source.poll()->seq == 1);
  CHECK(source.poll()->seq == 2);
  CHECK_FALSE(source.poll().has_value());
  CHECK(source.counts().foreign == (set ? 2 : 1));
  CHECK(source.last_error().find("127.0.0.3 are ignored, the controller is 127.0.0.2") !=
        std::string::npos);
}

TEST_CASE("HSPO source: a hand fixed in the flange is refused, for HSPO does not tell the flange") {
  RobotPoseSettings settings = any_port();
  settings.tool_in_flange = {0, 0, 0, 0, 0, 0};
  HspoSource source(settings, [] {});
  CHECK_THROWS_WITH(source.start(), Catch::Contains("robot_pose.tool_in_flange"));
}
