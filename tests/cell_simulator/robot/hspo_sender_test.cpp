#include "services/cell_simulator/robot/hspo_sender.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <set>

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

struct Listener {
  int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  int port = 0;
  Listener() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
    socklen_t size = sizeof address;
    getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
    port = ntohs(address.sin_port);
    const timeval longest{20, 0};
    setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
  }
  ~Listener() { close(socket); }
  std::int64_t instant() const {
    std::int64_t value = 0;
    REQUIRE(recv(socket, &value, sizeof value, 0) == sizeof value);
    return value;
  }
};

std::vector<std::uint8_t> bytes_of(std::int64_t instant) {
  std::vector<std::uint8_t> bytes(sizeof instant);
  std::memcpy(bytes.data(), &instant, sizeof instant);
  return bytes;
}

}  // namespace

TEST_CASE("a packet for every instant, in order, the silent ones left out") {
  const Listener listener;
  constexpr std::int64_t kPeriod = 5000;
  const auto silent = [](std::int64_t instant) { return instant / kPeriod % 3 == 0; };
  HspoSender sender("127.0.0.1", listener.port, kPeriod, [&](std::int64_t instant) {
    return silent(instant) ? std::vector<std::uint8_t>() : bytes_of(instant);
  });
  std::int64_t last = listener.instant();
  for (int i = 0; i < 30; ++i) {
    const std::int64_t instant = listener.instant();
    CHECK(instant % kPeriod == 0);
    CHECK_FALSE(silent(instant));
    CHECK(instant - last == (silent(last + kPeriod) ? 2 : 1) * kPeriod);
    last = instant;
  }
  CHECK(sender.sent() >= 30);  // the last may not be counted yet
}

TEST_CASE("nobody listening is no error, and a listener that comes later gets every packet") {
  int port = 0;
  {
    const Listener gone;
    port = gone.port;
  }
  HspoSender sender("127.0.0.1", port, 5000, bytes_of);
  while (sender.sent() < 5) usleep(1000);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  const int late = socket(AF_INET, SOCK_DGRAM, 0);
  REQUIRE(bind(late, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  std::int64_t first = 0, second = 0;
  REQUIRE(recv(late, &first, sizeof first, 0) == sizeof first);
  REQUIRE(recv(late, &second, sizeof second, 0) == sizeof second);
  CHECK(second - first == 5000);
  close(late);
}

TEST_CASE("a host that is no address is refused with what to do") {
  CHECK_THROWS_WITH(HspoSender("robot.example", 60015, 20000, bytes_of),
                    Catch::Contains("hspo_host"));
}
