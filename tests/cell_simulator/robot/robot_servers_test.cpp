// The simulated controllers on the network, on 127.0.0.1, talked to byte by byte.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstring>

#include "common/time.hpp"
#include "services/cell_simulator/robot/j519_server.hpp"
#include "services/cell_simulator/robot/rtde_server.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

// A client's socket, connected to a port of this host.
class WireClient {
 public:
  WireClient(int type, int port) : socket_(socket(AF_INET, type, 0)) {
    sockaddr_in there{};
    there.sin_family = AF_INET;
    there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    there.sin_port = htons(static_cast<std::uint16_t>(port));
    REQUIRE(connect(socket_, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0);
    const timeval longest{20, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
  }
  ~WireClient() { close(socket_); }
  void send(const std::vector<std::uint8_t>& bytes) {
    REQUIRE(::send(socket_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()));
  }
  std::vector<std::uint8_t> datagram() {
    std::vector<std::uint8_t> bytes(1000);
    bytes.resize(static_cast<std::size_t>(
        std::max<ssize_t>(recv(socket_, bytes.data(), bytes.size(), 0), 0)));
    return bytes;
  }
  std::vector<std::uint8_t> bytes(std::size_t count) {
    std::vector<std::uint8_t> bytes(count);
    REQUIRE(recv(socket_, bytes.data(), count, MSG_WAITALL) == static_cast<ssize_t>(count));
    return bytes;
  }

 private:
  int socket_;
};

std::uint32_t word(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return std::uint32_t{bytes.at(at)} << 24 | std::uint32_t{bytes.at(at + 1)} << 16 |
         std::uint32_t{bytes.at(at + 2)} << 8 | bytes.at(at + 3);
}
double number(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  const std::uint64_t bits = std::uint64_t{word(bytes, at)} << 32 | word(bytes, at + 4);
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}
float single(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  const std::uint32_t bits = word(bytes, at);
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

// A tool 300 mm long at a place that tells the instant: x is its host time past `start` in mm/s.
struct Place {
  std::int64_t start = utime_now();
  DeviceClock clock{start, 7'000'000'000, -9};
  std::optional<RobotReport> operator()(std::int64_t instant) const {
    RobotReport report;
    report.clock_ns = clock.nanoseconds(instant);
    report.T_base_tool0 = RigidTransform::Identity();
    report.T_base_tool0.translation().x() = static_cast<double>(instant - start) * 1e-6;
    report.T_base_tool = report.T_base_tool0 * Eigen::Translation3d(0, 0, 300);
    return report;
  }
};

const std::vector<std::uint8_t> kStart{0, 0, 0, 200, 0, 0, 0, 4}, kStop{0, 0, 0, 2, 0, 0, 0, 4};

void wait_for(const std::function<bool()>& condition) {
  for (int i = 0; i < 2000 && !condition(); ++i) usleep(10'000);
  REQUIRE(condition());
}

}  // namespace

TEST_CASE("J519 server: capability, a stream of its own beat, and its end") {
  const Place place;
  const bool use_tcp = GENERATE(true, false);
  J519Server server({"127.0.0.1", 0, use_tcp ? 4 : 3, use_tcp, place.clock}, place);
  WireClient client(SOCK_DGRAM, server.port());
  std::vector<std::uint8_t> question(28);
  question[3] = 7;
  client.send(question);
  const auto capability = client.datagram();
  REQUIRE(capability.size() == 28);
  CHECK(word(capability, 20) == (use_tcp ? 4 : 3));
  CHECK(word(capability, 24) == (use_tcp ? 1 : 0));

  client.send(kStart);
  std::uint32_t last_stamp = 0;
  for (std::uint32_t i = 1; i <= 20; ++i) {
    const auto status = client.datagram();
    REQUIRE(status.size() == (use_tcp ? 416u : 388u));
    CHECK(word(status, 8) == i);
    const std::uint32_t stamp = word(status, 16);
    CHECK(stamp % 8 == 0);
    if (i > 1) CHECK(stamp == last_stamp + 8);
    last_stamp = stamp;
    // The place is that of the stamp: 7 s are shown at the start.
    CHECK(single(status, 20) == Approx(stamp * 1e-3 - 7).margin(1e-4));
    CHECK(single(status, 28) == (use_tcp ? 300 : 0));
  }
  client.send(kStop);
  wait_for([&] { return !server.streaming(); });
  CHECK_FALSE(server.alarm());
}

TEST_CASE(
    "J519 server: one client; a second one's start raises the alarm, a command is not known") {
  const Place place;
  J519Server server({"127.0.0.1", 0, 4, true, place.clock}, place);
  WireClient first(SOCK_DGRAM, server.port()), second(SOCK_DGRAM, server.port());
  first.send(kStart);
  wait_for([&] { return server.streaming(); });
  std::vector<std::uint8_t> command(344);
  command[3] = 201;
  first.send(command);
  wait_for([&] { return server.not_understood() == 1; });
  CHECK(server.streaming());
  second.send(kStart);
  wait_for([&] { return server.alarm(); });
  wait_for([&] { return !server.streaming(); });
}

TEST_CASE("RTDE server: handshake, data of its own beat, pause") {
  const Place place;
  RigidTransform tool = RigidTransform::Identity();
  tool.translation().z() = 300;
  RtdeServer server({"127.0.0.1", 0, tool, place.clock}, place);
  WireClient client(SOCK_STREAM, server.port());
  client.send({0, 5, 'V', 0, 1});
  CHECK(client.bytes(4) == std::vector<std::uint8_t>{0, 4, 'V', 0});
  client.send({0, 5, 'V', 0, 2});
  CHECK(client.bytes(4) == std::vector<std::uint8_t>{0, 4, 'V', 1});
  // 125 Hz; an unknown name gives no recipe.
  const auto ask = [&](const std::string& names) {
    std::vector<std::uint8_t> request{
        0, static_cast<std::uint8_t>(11 + names.size()), 'O', 0x40, 0x5f, 0x40, 0, 0, 0, 0, 0};
    request.insert(request.end(), names.begin(), names.end());
    client.send(request);
  };
  ask("timestamp,nonsense");
  auto answer = client.bytes(4 + 16);
  CHECK(answer[3] == 0);
  CHECK(std::string(answer.begin() + 4, answer.end()) == "DOUBLE,NOT_FOUND");
  ask("timestamp,actual_TCP_pose,tcp_offset");
  answer = client.bytes(4 + 24);
  CHECK(answer[3] == 1);
  client.send({0, 3, 'S'});
  CHECK(client.bytes(4) == std::vector<std::uint8_t>{0, 4, 'S', 1});
  double last = 0;
  for (int i = 0; i < 20; ++i) {
    const auto data = client.bytes(4 + 8 + 48 + 48);
    REQUIRE(data[2] == 'U');
    const double stamp = number(data, 4);
    if (i > 0) CHECK(stamp - last == Approx(0.008).margin(2e-6));
    last = stamp;
    CHECK(number(data, 12) == Approx((stamp - 7) * 1e-3).margin(1e-7));
    CHECK(number(data, 28) == Approx(0.3));
    CHECK(number(data, 76) == Approx(0.3));
  }
  wait_for([&] { return server.streams() == 1; });
  client.send({0, 3, 'P'});
  wait_for([&] { return server.streams() == 0; });
}

TEST_CASE("a port that is taken is said, with the key to set") {
  const Place place;
  const J519Server j519({"127.0.0.1", 0, 4, true, place.clock}, place);
  CHECK_THROWS_WITH(J519Server({"127.0.0.1", j519.port(), 4, true, place.clock}, place),
                    Catch::Contains("set j519_port"));
  const RtdeServer rtde({"127.0.0.1", 0, RigidTransform::Identity(), place.clock}, place);
  CHECK_THROWS_WITH(
      RtdeServer({"127.0.0.1", rtde.port(), RigidTransform::Identity(), place.clock}, place),
      Catch::Contains("set rtde_port"));
}
