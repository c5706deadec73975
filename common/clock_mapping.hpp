// A device's clock mapped to the host's by the lower envelope of arrival - device time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace arcstart {

// Every message arrives late by an unknown delay that is never negative, so the smallest
// differences of arrival and device time lie nearest to the clocks' true difference. The clocks
// drift apart (crystals differ by some 50 parts per million: 3 ms a minute), so the envelope is a
// line: the lower convex hull's edge under the middle of the window (Zhang, Liu, Xia: Clock
// synchronization algorithms for network measurements, 2002). Host times that come out never go
// back.
class ClockMapping {
 public:
  // window: how long a small difference counts, us of device time.
  explicit ClockMapping(std::int64_t window_us = 120'000'000);

  // Takes in one message and returns its device time on the host's clock. All in us. Device times
  // rise; one that does not begins anew, as after restart().
  std::int64_t map(std::int64_t device_us, std::int64_t arrival_us);

  // While frozen (a scan runs) the line stays as it is; the first message ever sets it all the
  // same.
  void freeze(bool frozen) { frozen_ = frozen; }

  // Forgets all but the last host time given out: the device has begun a new clock.
  void restart();

  // Host time less device time at the newest message. Nothing before the first.
  std::optional<std::int64_t> offset_us() const;

  // How much faster the host's clock runs; parts per million, 0 until enough has been seen.
  double drift_ppm() const { return drift_ * 1e6; }

  // By how much the last result was moved so as not to go back, us. More than some ms: the host's
  // clock was set back, and the result is not the time of the measurement.
  std::int64_t held_back_us() const { return held_back_us_; }

 private:
  struct Point {  // smallest difference of a short stretch of device time, counted from the base
    std::int64_t device_us;
    double difference_us;
  };
  bool host_clock_was_set(std::int64_t device_us, std::int64_t arrival_us);
  bool take_in(std::int64_t device_us, std::int64_t arrival_us);
  void fit();
  double line_at(std::int64_t device_us) const;

  std::int64_t window_us_;
  std::int64_t stretch_us_;  // of device time that one point stands for
  std::deque<Point> points_;
  std::int64_t base_us_ = 0;              // difference that the points' are counted from
  std::int64_t reference_device_us_ = 0;  // line: offset_ + drift_ * (device - reference)
  double offset_ = 0;
  double drift_ = 0;
  std::int64_t last_device_us_ = 0;
  std::optional<std::int64_t> last_host_us_;
  std::int64_t held_back_us_ = 0;
  std::int64_t late_since_us_ = 0;  // device time since when every message has come very late
  bool late_ = false;
  bool begun_ = false;
  bool frozen_ = false;
  bool stale_ = false;  // points have come since the line was fitted
};

}  // namespace arcstart
