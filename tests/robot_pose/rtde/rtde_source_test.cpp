// The real socket, on 127.0.0.1, against controllers that answer well, late, half or not at all.
#include "services/robot_pose/rtde/rtde_source.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <list>
#include <thread>

#include "common/time.hpp"
#include "tests/robot_pose/rtde/rtde_bytes.hpp"

using namespace arcstart;
using namespace arcstart::robot_pose;
using namespace arcstart::test;

namespace {

// Listens on a port of its own; what it does with a connection is the test's.
class ScriptedController {
 public:
  ScriptedController() {
    socket_ = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(bind(socket_, reinterpret_cast<sockaddr*>(&here), sizeof here) == 0);
    REQUIRE(listen(socket_, 8) == 0);
    socklen_t size = sizeof here;
    getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &size);
    port_ = ntohs(here.sin_port);
  }
  ~ScriptedController() {
    hang_up();
    close(socket_);
  }
  int port() const { return port_; }

  void accept_one() {
    pollfd waiting{socket_, POLLIN, 0};
    REQUIRE(poll(&waiting, 1, 20'000) == 1);
    client_ = accept(socket_, nullptr, nullptr);
    REQUIRE(client_ >= 0);
  }
  // The next so many bytes; fewer where the other side has closed or 10 s have passed.
  std::vector<std::uint8_t> receive(std::size_t size) {
    std::vector<std::uint8_t> bytes;
    while (bytes.size() < size) {
      pollfd waiting{client_, POLLIN, 0};
      std::uint8_t byte;
      if (poll(&waiting, 1, 10'000) != 1 || recv(client_, &byte, 1, 0) != 1) break;
      bytes.push_back(byte);
    }
    return bytes;
  }
  void send(const std::vector<std::uint8_t>& bytes) {
    ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  void hang_up() {
    if (client_ >= 0) close(client_);
    client_ = -1;
  }
  void shake_hands() {
    accept_one();
    REQUIRE(receive(5) == from_hex("00 05 56 00 02"));
    send(rtde_frame('V', {1}));
    REQUIRE(receive(56).size() == 56);
    send(rtde_types(1, kAllVectors));
    REQUIRE(receive(3) == from_hex("00 03 53"));
    send(rtde_frame('S', {1}));
  }

 private:
  int socket_, client_ = -1, port_ = 0;
};

RobotPoseSettings at_port(int port) {
  RobotPoseSettings settings;
  settings.protocol = "rtde";
  settings.controller_address = "127.0.0.1";
  settings.controller_port = port;
  return settings;
}

void wait_until(const std::function<bool()>& condition) {
  bool met = condition();
  for (int i = 0; i < 2000 && !met; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    met = condition();
  }
  REQUIRE(met);
}

bool says(const RtdeSource& source, const std::string& words) {
  return source.why_silent().find(words) != std::string::npos;
}

std::optional<ReportedPosition> next_position(RtdeSource& source) {
  std::optional<ReportedPosition> position;
  wait_until([&] { return (position = source.poll()).has_value(); });
  return position;
}

}  // namespace

TEST_CASE("RTDE source: positions with the kernel's arrival time, over a new connection too") {
  ScriptedController controller;
  std::atomic<int> notified = 0;
  RtdeSource source(at_port(controller.port()), [&] { ++notified; });
  source.start();
  controller.shake_hands();
  const std::int64_t before = utime_now();
  controller.send(rtde_data(1));
  const auto first = next_position(source);
  CHECK(first->arrival_utime >= before);
  CHECK(first->arrival_utime <= utime_now());
  CHECK(notified >= 1);
  CHECK(source.why_silent() == "");
  // Two at once and half a third, then its rest.
  auto bytes = rtde_data(1.008), third = rtde_data(1.024);
  const auto second = rtde_data(1.016);
  bytes.insert(bytes.end(), second.begin(), second.end());
  bytes.insert(bytes.end(), third.begin(), third.begin() + 70);
  controller.send(bytes);
  CHECK(next_position(source)->seq == first->seq + 1);
  CHECK(next_position(source)->seq == first->seq + 2);
  CHECK_FALSE(source.poll().has_value());
  controller.send({third.begin() + 70, third.end()});
  CHECK(next_position(source)->seq == first->seq + 3);

  controller.hang_up();
  wait_until([&] { return says(source, "the controller closed the connection"); });
  controller.shake_hands();
  controller.send(rtde_data(1.048));
  CHECK(next_position(source)->seq == first->seq + 6);
  CHECK(source.counts().lost == 2);
  CHECK(source.counts().received == 5);
}

TEST_CASE("RTDE source: the stream is paused at the end") {
  ScriptedController controller;
  {
    RtdeSource source(at_port(controller.port()), [] {});
    source.start();
    controller.shake_hands();
    controller.send(rtde_data(1));
    next_position(source);
  }
  CHECK(controller.receive(4) == from_hex("00 03 50"));
}

TEST_CASE("RTDE source: a controller that answers late, half or not at all, each in its words") {
  ScriptedController silent, half, late, hanging_up, wrong_port, stalling;
  std::list<RtdeSource> sources;
  const auto source = [&](const ScriptedController& controller) -> RtdeSource& {
    RtdeSource& made = sources.emplace_back(at_port(controller.port()), [] {});
    made.start();
    return made;
  };
  // Two seconds pass before the next connection changes the words.
  RtdeSource& of_hanging_up = source(hanging_up);
  hanging_up.accept_one();
  hanging_up.receive(5);  // what is not read would reset the connection
  hanging_up.send({0, 4, 'V'});
  hanging_up.hang_up();
  wait_until([&] { return says(of_hanging_up, "owes an answer to the request for version 2"); });
  CHECK(says(of_hanging_up, "closed the connection"));
  CHECK(says(of_hanging_up, "in the middle of a frame (3 bytes of it came)"));
  RtdeSource& of_wrong_port = source(wrong_port);
  wrong_port.accept_one();
  wrong_port.send(from_hex("00 00 05 6c 10 00 00 00 2f 00"));
  wait_until([&] { return says(of_wrong_port, "no RTDE, it begins with 00 00 05: is the port"); });

  RtdeSource& of_silent = source(silent);
  RtdeSource& of_half = source(half);
  half.accept_one();
  half.send({0, 4});
  RtdeSource& of_late = source(late);
  late.accept_one();
  late.receive(5);
  late.send(rtde_frame('V', {1}));
  RtdeSource& of_stalling = source(stalling);
  stalling.shake_hands();
  stalling.send(rtde_data(1));
  wait_until([&] { return says(of_stalling, "stopped sending data over a live connection"); });
  wait_until([&] {
    return says(of_silent,
                "2 s later has not gone on and owes an answer to the request for version 2");
  });
  CHECK_FALSE(says(of_silent, "in the middle"));
  wait_until([&] { return says(of_half, "in the middle of a frame (2 bytes of it came)"); });
  wait_until([&] { return says(of_late, "owes an answer to the output recipe"); });
  // Late by more than it may be: the answer comes to a connection that has ended.
  late.send(rtde_types(1, kAllVectors));
  CHECK(late.receive(57).size() < 57);
  for (const RtdeSource& one : sources) CHECK(one.why_silent().find('\n') == std::string::npos);
}

TEST_CASE("RTDE source: nobody there, and no address") {
  int port = 0;
  {
    const ScriptedController gone;
    port = gone.port();
  }
  RtdeSource source(at_port(port), [] {});
  source.start();
  wait_until([&] { return says(source, "refuses the connection: is the robot on, RTDE allowed"); });
  CHECK(source.description() == "RTDE from 127.0.0.1:" + std::to_string(port));

  RobotPoseSettings nowhere;
  RtdeSource without(nowhere, [] {});
  CHECK_THROWS_WITH(without.start(), Catch::Contains("robot_pose.controller_address"));
}
