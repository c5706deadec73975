#include "common/service_role.hpp"

#include <fmt/core.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>

#include "common/time.hpp"

namespace arcstart {
namespace {

constexpr std::int64_t kStillThere = 3'000'000;  // us since its last STATUS, which comes at 1 Hz

}  // namespace

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

// An abstract socket's name belongs to the host's network, as the bus does.
void claim_role(const std::string& service, const std::string& whose, const std::string& channel,
                const BusSettings& bus) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  const std::string text = fmt::format("arcstart/{}/{}:{}", channel, bus.group, bus.port);
  const std::size_t length = std::min(text.size(), sizeof name.sun_path - 1);
  text.copy(name.sun_path + 1, length);
  const int role = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (bind(role, reinterpret_cast<const sockaddr*>(&name),
           static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length)) != 0 &&
      errno == EADDRINUSE)
    throw InputError(fmt::format("{} runs on this host already, for {} on {}:{}: end it first",
                                 service, whose, bus.group, bus.port));
}

TwinWatch::TwinWatch(Bus& bus, const std::string& channel, const std::string& service,
                     std::int64_t run_id)
    : service_(service) {
  bus.subscribe<service_status_t>(
      channel, Queue::measurements(), [this, run_id](const service_status_t& status) {
        const bool is_own =
            status.run_id == run_id && status.pid == getpid() && status.host == host_;
        if (is_own || status.state == service_status_t::STOPPING) return;
        heard_ = steady_now();
        where_ = fmt::format("host {}, pid {}", status.host, status.pid);
      });
}

std::string TwinWatch::trouble() const {
  if (heard_ == 0 || steady_now() - heard_ > kStillThere) return "";
  return fmt::format("another {} does the same work: {}; this one is host {}, pid {}: end one",
                     service_, where_, host_, getpid());
}

}  // namespace arcstart
