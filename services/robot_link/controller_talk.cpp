#include "services/robot_link/controller_talk.hpp"

#include <algorithm>
#include <chrono>

#include "common/time.hpp"

namespace arcstart::robot_link {
namespace {

using std::chrono::microseconds;

// A controller frees a session 0.2 to 2.7 s after its client went.
constexpr std::int64_t kRetryFirst = 250'000, kRetryLongest = 2'000'000;  // us
// Between operations where the controller is faster: two hundred a second are enough for 2 Hz.
constexpr std::int64_t kPause = 5'000;  // us

}  // namespace

ControllerTalk::ControllerTalk(std::unique_ptr<ControllerLink> link)
    : link_(std::move(link)), description_(link_->description()) {
  thread_ = std::thread([this] { run(); });
}

ControllerTalk::~ControllerTalk() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ended_.notify_all();
  link_->end();
  thread_.join();
}

void ControllerTalk::run() {
  for (std::int64_t pause = kRetryFirst;;) {
    const std::int64_t before = operations();
    const std::string why = talk();
    if (operations() > before) pause = kRetryFirst;
    std::unique_lock lock(mutex_);
    handshake_.lost();
    connected_ = false;
    trouble_ = why;
    if (ended_.wait_for(lock, microseconds(pause), [this] { return ending_; })) return;
    pause = std::min(2 * pause, kRetryLongest);
  }
}

std::string ControllerTalk::talk() {
  try {
    link_->connect();
    for (;;) {
      const std::int64_t begun = steady_now();
      Operation operation;
      {
        const std::lock_guard lock(mutex_);
        if (ending_) return "ended";
        operation = handshake_.next(begun);
      }
      const Reading reading = link_->carry_out(operation);
      std::unique_lock lock(mutex_);
      handshake_.take(operation, reading, steady_now());
      ++operations_;
      connected_ = true;
      trouble_.clear();
      const std::int64_t left = begun + kPause - steady_now();
      if (left > 0) ended_.wait_for(lock, microseconds(left), [this] { return ending_; });
    }
  } catch (const LinkError& error) {
    return error.what();
  }
}

bool ControllerTalk::connected() const {
  const std::lock_guard lock(mutex_);
  return connected_;
}

std::string ControllerTalk::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

std::int64_t ControllerTalk::operations() const {
  const std::lock_guard lock(mutex_);
  return operations_;
}

}  // namespace arcstart::robot_link
