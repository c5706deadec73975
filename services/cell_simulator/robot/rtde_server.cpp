#include "services/cell_simulator/robot/rtde_server.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "common/time.hpp"
#include "services/cell_simulator/robot/device_beat.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::uint8_t kRecipe = 1;
constexpr double kFastest = 500;  // Hz, of an e-Series

std::int64_t period_ns(const RtdeOutputs& outputs) { return std::llround(1e9 / outputs.rate_hz); }

void send_all(int socket, const std::vector<std::uint8_t>& bytes) {
  ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
}

}  // namespace

RtdeServer::RtdeServer(const RtdeServerSettings& settings, Report report)
    : settings_(settings), report_(std::move(report)) {
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(static_cast<std::uint16_t>(settings_.port));
  inet_pton(AF_INET, settings_.address.c_str(), &here.sin_addr);
  socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0 ||
      listen(socket_, 4) != 0) {
    const std::string why = std::strerror(errno);
    close(socket_);
    throw std::runtime_error(fmt::format("cannot serve RTDE on TCP {}:{} ({}): set rtde_port",
                                         settings_.address, settings_.port, why));
  }
  socklen_t size = sizeof here;
  getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &size);
  port_ = ntohs(here.sin_port);
  thread_ = std::thread([this] { run(); });
}

RtdeServer::~RtdeServer() {
  ending_ = true;
  thread_.join();
  for (const Client& client : clients_) close(client.socket);
  close(socket_);
}

void RtdeServer::run() {
  constexpr std::int64_t kLongestWait = 50'000;  // us
  prctl(PR_SET_TIMERSLACK, 1000ul);              // ns
  while (!ending_) {
    std::vector<pollfd> waiting{{socket_, POLLIN, 0}};
    std::int64_t until = utime_now() + kLongestWait;
    for (const Client& client : clients_) {
      waiting.push_back({client.socket, POLLIN, 0});
      if (client.streaming) until = std::min(until, client.beat);
    }
    const timespec longest{0, std::max<std::int64_t>(until - utime_now(), 0) * 1000};
    ppoll(waiting.data(), waiting.size(), &longest, nullptr);
    std::size_t place = 1;
    for (auto client = clients_.begin(); client != clients_.end(); ++place) {
      if (waiting[place].revents == 0 || receive(*client)) {
        ++client;
      } else {
        close(client->socket);
        client = clients_.erase(client);
      }
    }
    if (waiting[0].revents) {
      const int socket = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
      const int on = 1;
      setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      if (socket >= 0) clients_.push_back({socket, {}, {}, false, 0});
    }
    send_due(utime_now());
  }
}

bool RtdeServer::receive(Client& client) {
  std::uint8_t bytes[2048];
  const ssize_t size = recv(client.socket, bytes, sizeof bytes, MSG_DONTWAIT);
  if (size <= 0) return size < 0 && errno == EAGAIN;
  client.received.insert(client.received.end(), bytes, bytes + size);
  while (const auto request = take_rtde_request(client.received)) answer(client, *request);
  return true;
}

void RtdeServer::answer(Client& client, const RtdeRequest& request) {
  const auto& payload = request.payload;
  switch (request.type) {
    case 'V':
      send_all(client.socket,
               rtde_yes_or_no('V', payload.size() == 2 && payload[0] == 0 && payload[1] == 2));
      break;
    case 'O': {
      const auto outputs = understand_rtde_outputs(payload);
      std::string types;
      bool good = outputs && outputs->rate_hz > 0 && outputs->rate_hz <= kFastest;
      for (const std::string& name : outputs ? outputs->names : std::vector<std::string>()) {
        types += (types.empty() ? "" : ",") + rtde_type_of(name);
        good = good && rtde_type_of(name) != "NOT_FOUND";
      }
      client.outputs = good ? *outputs : RtdeOutputs{};
      send_all(client.socket, rtde_recipe_bytes(good ? kRecipe : 0, types));
      break;
    }
    case 'S':
    case 'P': {
      const bool known = client.outputs.rate_hz > 0;
      client.streaming = known && request.type == 'S';
      if (client.streaming)
        client.beat = next_beat(settings_.clock, period_ns(client.outputs), utime_now());
      send_all(client.socket, rtde_yes_or_no(request.type, known));
      break;
    }
    default:
      break;
  }
}

void RtdeServer::send_due(std::int64_t now) {
  int streams = 0;
  for (Client& client : clients_) {
    if (!client.streaming) continue;
    ++streams;
    if (now < client.beat) continue;
    // A beat that is late is reported all the same: its stamp says when it holds.
    if (const auto report = report_(client.beat))
      send_all(client.socket,
               rtde_data_bytes(kRecipe, client.outputs.names, *report, settings_.T_tool0_tool));
    client.beat = next_beat(settings_.clock, period_ns(client.outputs), client.beat);
  }
  streams_ = streams;
}

}  // namespace arcstart::cell_simulator
