// Sends the controller's packets over UDP, one each period of the host's clock.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace arcstart::cell_simulator {

class HspoSenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class HspoSender {
 public:
  // Bytes for an instant (us, UTC; a multiple of the period); none: nothing is sent for it.
  using Packet = std::function<std::vector<std::uint8_t>(std::int64_t instant)>;

  // host: an IPv4 address. Throws HspoSenderError where it is none. A packet that nobody takes is
  // no error.
  HspoSender(const std::string& host, int port, std::int64_t period_us, Packet packet);
  ~HspoSender();
  HspoSender(const HspoSender&) = delete;
  HspoSender& operator=(const HspoSender&) = delete;

  std::int64_t sent() const { return sent_; }

 private:
  void run(std::int64_t period_us);

  Packet packet_;
  int socket_;
  std::atomic<bool> ending_{false};
  std::atomic<std::int64_t> sent_{0};
  std::thread thread_;
};

}  // namespace arcstart::cell_simulator
