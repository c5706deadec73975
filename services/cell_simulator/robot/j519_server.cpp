#include "services/cell_simulator/robot/j519_server.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <numbers>

#include "common/time.hpp"
#include "services/cell_simulator/robot/device_beat.hpp"
#include "services/cell_simulator/robot/j519_packet.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::int64_t kInterpolation = 8'000'000;  // ns: the controller's interpolation time

}  // namespace

J519Server::J519Server(const J519ServerSettings& settings, Report report)
    : settings_(settings), report_(std::move(report)) {
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(static_cast<std::uint16_t>(settings_.port));
  inet_pton(AF_INET, settings_.address.c_str(), &here.sin_addr);
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0) {
    const std::string why = std::strerror(errno);
    close(socket_);
    throw std::runtime_error(fmt::format("cannot serve J519 on UDP {}:{} ({}): set j519_port",
                                         settings_.address, settings_.port, why));
  }
  socklen_t size = sizeof here;
  getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &size);
  port_ = ntohs(here.sin_port);
  thread_ = std::thread([this] { run(); });
}

J519Server::~J519Server() {
  ending_ = true;
  thread_.join();
  close(socket_);
}

void J519Server::run() {
  constexpr std::int64_t kLongestWait = 50'000;  // us
  prctl(PR_SET_TIMERSLACK, 1000ul);              // ns
  std::int64_t beat = next_beat(settings_.clock, kInterpolation, utime_now());
  while (!ending_) {
    const std::int64_t until = streaming_ ? beat - utime_now() : kLongestWait;
    const std::int64_t wait = std::clamp<std::int64_t>(until, 0, kLongestWait);
    const timespec longest{0, wait * 1000};
    pollfd asked{socket_, POLLIN, 0};
    if (ppoll(&asked, 1, &longest, nullptr) > 0) answer();
    if (const std::int64_t now = utime_now(); now >= beat) {
      // A beat that is late is reported all the same: its stamp says when it holds.
      if (streaming_) send_place(beat);
      beat = next_beat(settings_.clock, kInterpolation, streaming_ ? beat : now);
    }
  }
}

void J519Server::answer() {
  std::vector<std::uint8_t> bytes(2048), sender(sizeof(sockaddr_in));
  socklen_t size = sizeof(sockaddr_in);
  auto* from = reinterpret_cast<sockaddr*>(sender.data());
  const ssize_t length = recvfrom(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT, from, &size);
  if (length < 0) return;
  bytes.resize(static_cast<std::size_t>(length));
  const auto asked = understand_j519(bytes);
  if (!asked) {
    ++not_understood_;
    return;
  }
  switch (asked->what) {
    case J519Request::kCapability: {
      const auto reply = j519_capability_bytes(8, static_cast<std::uint32_t>(settings_.version),
                                               settings_.use_tcp);
      sendto(socket_, reply.data(), reply.size(), 0, from, size);
      break;
    }
    case J519Request::kStop:
      streaming_ = false;
      client_.clear();
      break;
    case J519Request::kStart:
      if (!client_.empty()) alarm_ = true;
      client_ = sender;
      client_version_ = asked->version;
      streaming_ = !alarm_;
      sequence_ = 0;
      break;
  }
}

void J519Server::send_place(std::int64_t instant) {
  const auto report = report_(instant);
  const std::uint32_t sequence = ++sequence_;
  if (!report) return;
  J519Place place;
  place.version = std::min(client_version_, static_cast<std::uint32_t>(settings_.version));
  place.sequence = sequence;
  place.time_stamp =
      static_cast<std::uint32_t>(std::llround(static_cast<double>(report->clock_ns) * 1e-6));
  place.position = to_xyzwpr(settings_.use_tcp ? report->T_base_tool : report->T_base_tool0);
  // Not coupled to J2, other than on the pendant.
  for (std::size_t i = 0; i < report->joints.size(); ++i)
    place.joints_deg[i] = report->joints[i] * 180 / std::numbers::pi;
  const auto bytes = j519_status_bytes(place);
  sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(client_.data()),
         sizeof(sockaddr_in));
}

}  // namespace arcstart::cell_simulator
