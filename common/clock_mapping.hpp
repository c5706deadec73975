// A device's clock mapped to the host's by the lower envelope of arrival - device time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace arcstart {

// Every message arrives late by an unknown delay that is never negative, so the smallest difference
// seen in a window is nearest to the clocks' true difference. Host times that come out never go
// back within a run.
class ClockMapping {
 public:
  // window: how long a smallest difference stays valid, us of device time.
  explicit ClockMapping(std::int64_t window_us = 30'000'000) : window_us_(window_us) {}

  // Takes in one message and returns its device time on the host's clock. All in us.
  std::int64_t map(std::int64_t device_us, std::int64_t arrival_us);

  // While frozen (a scan runs) the offset stays as it is; the first message ever sets it all the
  // same.
  void freeze(bool frozen) { frozen_ = frozen; }

  // Forgets all: the device has begun a new clock.
  void restart();

  std::optional<std::int64_t> offset_us() const { return offset_us_; }

 private:
  struct Difference {
    std::int64_t device_us;
    std::int64_t difference_us;
  };
  std::int64_t window_us_;
  std::deque<Difference>
      smallest_;  // differences rising from front to back: the front is the window's minimum
  std::optional<std::int64_t> offset_us_;
  std::optional<std::int64_t> last_host_us_;
  bool frozen_ = false;
};

}  // namespace arcstart
