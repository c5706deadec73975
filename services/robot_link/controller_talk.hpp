// The thread that carries the handshake to the controller: connects, does what the handshake asks
// for, and connects again when that ends.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "services/robot_link/controller_link.hpp"
#include "services/robot_link/handshake/handshake.hpp"

namespace arcstart::robot_link {

class ControllerTalk {
 public:
  explicit ControllerTalk(std::unique_ptr<ControllerLink> link);
  ~ControllerTalk();
  ControllerTalk(const ControllerTalk&) = delete;
  ControllerTalk& operator=(const ControllerTalk&) = delete;

  // Something is told to the handshake, or asked of it; from any thread.
  template <class Function>
  auto with(Function function) {
    const std::lock_guard lock(mutex_);
    return function(handshake_);
  }

  bool connected() const;
  std::string trouble() const;  // why not: one line; empty while connected
  std::int64_t operations() const;
  std::string description() const { return description_; }

 private:
  void run();
  std::string talk();  // until the connection is no use any more: why

  std::unique_ptr<ControllerLink> link_;  // the thread's alone, but for end()
  std::string description_;
  mutable std::mutex mutex_;  // of all below
  std::condition_variable ended_;
  bool ending_ = false, connected_ = false;
  std::string trouble_ = "no connection has been tried yet";
  std::int64_t operations_ = 0;
  Handshake handshake_;
  std::thread thread_;
};

}  // namespace arcstart::robot_link
