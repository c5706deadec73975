// A bad network between two halves of a cell: what is sent on one port goes to the other, message
// by message, with losses, doubles, delays and a link that goes down. Seeded: the same messages in
// the same order fare alike.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <random>
#include <string>
#include <thread>

#include "common/bus/bus.hpp"

namespace arcstart {

struct LinkFaults {
  double lost = 0, doubled = 0, delayed = 0;  // shares of the messages, 0 to 1
  std::int64_t delay_us = 0;                  // of those delayed; others overtake them
};

class LossyRelay {
 public:
  // From the port `near`, where the devices are, to `far`. Answers and STATUS come back whole.
  LossyRelay(int near, int far, std::uint32_t seed);

  void set(const LinkFaults& faults);

  // Nothing gets through from now on, for so many us.
  void take_down(std::int64_t us);

  std::int64_t lost() const { return lost_; }        // messages
  std::int64_t doubled() const { return doubled_; }  // likewise

 private:
  struct Waiting {
    std::int64_t due;  // us, steady
    std::string channel;
    Bus::Bytes bytes;
  };
  void run(const std::stop_token& end);
  void carry(const Bus::Bytes& bytes, const std::string& channel);

  Bus near_, far_;
  std::mutex guard_;  // of faults_ and down_until_
  LinkFaults faults_;
  std::mt19937 random_;
  std::deque<Waiting> waiting_;  // in order of due
  std::int64_t down_until_ = 0;  // us, steady
  std::atomic<std::int64_t> lost_ = 0, doubled_ = 0;
  std::jthread thread_;  // last, so that it ends first
};

}  // namespace arcstart
