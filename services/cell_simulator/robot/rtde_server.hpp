// A Universal Robots controller's RTDE on TCP: it serves its clients with the outputs that they
// ask for, of those in rtde_frames.hpp.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <thread>

#include "services/cell_simulator/robot/robot_controller.hpp"
#include "services/cell_simulator/robot/rtde_frames.hpp"

namespace arcstart::cell_simulator {

struct RtdeServerSettings {
  std::string address = "127.0.0.1";
  int port = 30004;  // 0: any
  RigidTransform T_tool0_tool = RigidTransform::Identity();
  DeviceClock clock;
};

class RtdeServer {
 public:
  // The place at an instant (us, UTC); nothing: no package is sent for it.
  using Report = std::function<std::optional<RobotReport>(std::int64_t instant)>;

  // Throws std::runtime_error where the port cannot be had.
  RtdeServer(const RtdeServerSettings& settings, Report report);
  ~RtdeServer();
  RtdeServer(const RtdeServer&) = delete;
  RtdeServer& operator=(const RtdeServer&) = delete;

  int port() const { return port_; }
  int streams() const { return streams_; }  // clients that are sent data

 private:
  struct Client {
    int socket;
    std::vector<std::uint8_t> received;
    RtdeOutputs outputs;
    bool streaming = false;
    std::int64_t beat = 0;  // next package; us, UTC
  };
  void run();
  bool receive(Client& client);  // false: the client has gone
  void answer(Client& client, const RtdeRequest& request);
  void send_due(std::int64_t now);

  RtdeServerSettings settings_;
  Report report_;
  int socket_ = -1, port_ = 0;
  std::list<Client> clients_;
  std::atomic<bool> ending_{false};
  std::atomic<int> streams_{0};
  std::thread thread_;
};

}  // namespace arcstart::cell_simulator
