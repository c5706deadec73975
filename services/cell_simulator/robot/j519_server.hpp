// A Stream Motion controller on UDP: it streams the arm's place to one client every 8 ms. A second
// client's start raises an alarm that ends the stream and keeps it ended, and anybody's stop ends
// it, as on a real one.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "services/cell_simulator/robot/robot_controller.hpp"

namespace arcstart::cell_simulator {

struct J519ServerSettings {
  std::string address = "127.0.0.1";
  int port = 60015;  // 0: any
  int version = 4;   // the newest that it has: 3 or 4
  bool use_tcp = true;
  DeviceClock clock;
};

class J519Server {
 public:
  // The place at an instant (us, UTC); nothing: no packet is sent for it.
  using Report = std::function<std::optional<RobotReport>(std::int64_t instant)>;

  // Throws std::runtime_error where the port cannot be had.
  J519Server(const J519ServerSettings& settings, Report report);
  ~J519Server();
  J519Server(const J519Server&) = delete;
  J519Server& operator=(const J519Server&) = delete;

  int port() const { return port_; }
  bool streaming() const { return streaming_; }
  bool alarm() const { return alarm_; }                   // HOST-380
  int not_understood() const { return not_understood_; }  // packets, motion commands among them

 private:
  void run();
  void answer();
  void send_place(std::int64_t instant);

  J519ServerSettings settings_;
  Report report_;
  int socket_ = -1, port_ = 0;
  std::vector<std::uint8_t> client_;  // its socket address; empty: none has started
  std::uint32_t client_version_ = 0, sequence_ = 0;
  std::atomic<bool> streaming_{false}, alarm_{false}, ending_{false};
  std::atomic<int> not_understood_{0};
  std::thread thread_;
};

}  // namespace arcstart::cell_simulator
