// How long a tick of the controller's clock really is, by the rate of arrivals.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace arcstart::robot_pose {

class ClockRate {
 public:
  // One report: unwrapped device clock in ticks, arrival on the host's clock in us.
  void take(std::int64_t ticks, std::int64_t arrival_us);

  void restart() { *this = ClockRate(); }

  // us a tick over the last 2 s. Nothing before 5 reports over 0.2 s; then always the last one
  // known.
  std::optional<double> tick_us() const { return tick_us_; }

 private:
  struct Report {
    std::int64_t ticks, arrival_us;
  };
  std::deque<Report> reports_;
  std::optional<double> tick_us_;
};

}  // namespace arcstart::robot_pose
