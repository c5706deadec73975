// A FANUC controller's Remote Motion Interface on TCP: it answers FRC_Connect with a second port,
// where it serves one session, one request after the other. A second client may connect there and
// hears nothing while the first is there.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "services/cell_simulator/controller/controller_memory.hpp"

namespace arcstart::cell_simulator {

struct RmiServerSettings {
  std::string address = "127.0.0.1";
  int port = 16001;               // 0: any
  double request_ms = 66;         // a controller answers about 15 requests a second
  bool numeric_registers = true;  // controllers to manual /03 have none by RMI
  // For tests: from the n-th request on it says nothing, or half; 0: never.
  int silent_from = 0, half_from = 0;
};

class RmiServer {
 public:
  // Where the tool stands, in World.
  using Place = std::function<RigidTransform()>;

  // memory outlives it. Throws std::runtime_error where the port cannot be had.
  RmiServer(const RmiServerSettings& settings, ControllerMemory& memory, Place place);
  ~RmiServer();
  RmiServer(const RmiServer&) = delete;
  RmiServer& operator=(const RmiServer&) = delete;

  int port() const { return port_; }
  int requests() const { return requests_; }
  int motion_asked() const { return motion_asked_; }  // FRC_Initialize and instructions

  // The answer to a line, in a session; without CR LF.
  std::string answer(const std::string& line);

 private:
  void run();
  void greet(int socket);
  void serve(int socket);

  RmiServerSettings settings_;
  ControllerMemory& memory_;
  Place place_;
  int socket_ = -1, session_socket_ = -1, port_ = 0, session_port_ = 0;
  std::atomic<bool> ending_{false};
  std::atomic<int> requests_{0}, motion_asked_{0};
  std::thread greeter_, server_;
};

}  // namespace arcstart::cell_simulator
