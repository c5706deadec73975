#include "services/sensor_capture/clocks/clock_comparison.hpp"

#include <algorithm>

namespace arcstart::sensor_capture {
namespace {

// Two crystals of 100 parts per million each, and some for a clock that is slewed.
constexpr double kDrift = 250e-6;
// After so long drift has widened a bound to 15 ms.
constexpr std::int64_t kKept = 60'000'000;  // us
// One that took longer says nothing, or a clock was set within it.
constexpr std::int64_t kLongest = 1'000'000;  // us

}  // namespace

void ClockInterval::widen(const ClockInterval& other) {
  lowest = std::min(lowest, other.lowest);
  highest = std::max(highest, other.highest);
}

void ClockComparison::take(const ClockExchange& exchange, std::int64_t now) {
  const std::int64_t on_the_way =
      (exchange.answer_heard - exchange.asked) - (exchange.answered - exchange.heard);
  if (on_the_way < 0 || on_the_way > kLongest || exchange.answered < exchange.heard) return;
  while (!exchanges_.empty() && now - exchanges_.front().now > kKept) exchanges_.pop_front();
  const auto known = all_at(now);
  const Bounds bounds{now, static_cast<double>(exchange.answered - exchange.answer_heard),
                      static_cast<double>(exchange.heard - exchange.asked)};
  if (known && (bounds.lowest > known->highest || bounds.highest < known->lowest)) {
    const auto possible = at(now);  // with what an earlier step left
    before_ = possible;
    step_ = now;
    ++steps_;
    exchanges_.clear();
  }
  exchanges_.push_back(bounds);
}

std::optional<ClockInterval> ClockComparison::all_at(std::int64_t now) const {
  if (exchanges_.empty() || now - exchanges_.back().now > kKept) return std::nullopt;
  ClockInterval all{-1e18, 1e18};
  for (const Bounds& one : exchanges_) {
    const double drift = kDrift * static_cast<double>(now - one.now);
    all.lowest = std::max(all.lowest, one.lowest - drift);
    all.highest = std::min(all.highest, one.highest + drift);
  }
  return all;
}

std::optional<ClockInterval> ClockComparison::at(std::int64_t now) const {
  auto all = all_at(now);
  if (all && before_ && now - step_ < kFollows) all->widen(*before_);
  return all;
}

void ClockComparison::restart() { exchanges_.clear(); }

}  // namespace arcstart::sensor_capture
