// How far another host's clock is from this one's, from four-stamp exchanges (RFC 5905, 8).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace arcstart::sensor_capture {

// What is known of a difference, other clock less this one; us.
struct ClockInterval {
  double lowest, highest;

  double difference() const { return (lowest + highest) / 2; }
  double bound() const { return (highest - lowest) / 2; }  // by how much that may be wrong
  void widen(const ClockInterval& other);                  // to hold both
};

// One exchange; us, UTC.
struct ClockExchange {
  std::int64_t asked, answer_heard;  // by this host's clock
  std::int64_t heard, answered;      // by the other's
};

// Each exchange bounds the difference: the question left before it was heard, the answer before it
// was heard here. What holds for all of them holds (Marzullo's intersection), so that the quickest
// exchanges bound it and slow ones do no harm. A bound widens as it ages, for clocks drift.
class ClockComparison {
 public:
  // now: us on the steady clock, as in at().
  void take(const ClockExchange& exchange, std::int64_t now);

  // Nothing before the first exchange, and a minute after the last.
  std::optional<ClockInterval> at(std::int64_t now) const;

  // The other process has begun anew.
  void restart();

  // Clocks that are set show as exchanges that contradict each other. Stamps of devices follow a
  // clock that was set within ClockMapping's window, and for so long both differences are held to
  // be possible.
  static constexpr std::int64_t kFollows = 120'000'000;  // us

  std::int64_t steps() const { return steps_; }  // so often a clock was set

 private:
  struct Bounds {
    std::int64_t now;
    double lowest, highest;
  };
  std::optional<ClockInterval> all_at(std::int64_t now) const;

  std::deque<Bounds> exchanges_;         // of the last minute
  std::optional<ClockInterval> before_;  // a clock was set
  std::int64_t step_ = 0, steps_ = 0;    // when, steady; how often
};

}  // namespace arcstart::sensor_capture
