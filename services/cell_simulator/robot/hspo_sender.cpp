#include "services/cell_simulator/robot/hspo_sender.hpp"

#include <arpa/inet.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>

#include "common/time.hpp"

namespace arcstart::cell_simulator {

HspoSender::HspoSender(const std::string& host, int port, std::int64_t period_us, Packet packet)
    : packet_(std::move(packet)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1)
    throw HspoSenderError(host + ": not an IPv4 address: give hspo_host as in 127.0.0.1");
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    close(socket_);
    throw HspoSenderError(host + ": no way to this host: set hspo_host");
  }
  thread_ = std::thread([this, period_us] { run(period_us); });
}

HspoSender::~HspoSender() {
  ending_ = true;
  thread_.join();
  close(socket_);
}

void HspoSender::run(std::int64_t period_us) {
  constexpr std::int64_t kHopelesslyLate = 1'000'000;  // us
  prctl(PR_SET_TIMERSLACK, 1000ul);                    // ns
  std::int64_t instant = (utime_now() / period_us + 1) * period_us;
  while (!ending_) {
    const timespec when{instant / 1'000'000, instant % 1'000'000 * 1000};
    if (clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &when, nullptr) == EINTR) continue;
    const std::vector<std::uint8_t> bytes = packet_(instant);
    // A packet that is late goes out all the same: its clock says when it holds. Nobody listening
    // is refused here.
    if (!bytes.empty()) {
      if (send(socket_, bytes.data(), bytes.size(), 0) < 0 && errno == ECONNREFUSED)
        send(socket_, bytes.data(), bytes.size(), 0);  // the refusal was that of the packet before
      ++sent_;
    }
    instant += period_us;
    if (const std::int64_t now = utime_now(); now - instant > kHopelesslyLate)
      instant = (now / period_us + 1) * period_us;
  }
}

}  // namespace arcstart::cell_simulator
