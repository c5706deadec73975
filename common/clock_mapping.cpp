#include "common/clock_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace arcstart {
namespace {

// Below this much device time the delays' scatter would pass for drift.
constexpr std::int64_t kShortestForDrift = 10'000'000;
// No crystal is worse; host clocks are slewed by no more than this.
constexpr double kLargestDrift = 500e-6;
// A difference so far off the line, and lasting so long where it may be mere delay, means that the
// host's clock was set.
constexpr std::int64_t kClockStep = 250'000;
constexpr std::int64_t kLastingDelay = 2'000'000;

}  // namespace

ClockMapping::ClockMapping(std::int64_t window_us)
    : window_us_(window_us), stretch_us_(std::max<std::int64_t>(window_us / 120, 1)) {}

std::int64_t ClockMapping::map(std::int64_t device_us, std::int64_t arrival_us) {
  if (begun_ && device_us <= last_device_us_) restart();
  if (begun_ && !frozen_ && host_clock_was_set(device_us, arrival_us)) restart();
  const bool first = !begun_;
  if (first) {
    base_us_ = arrival_us - device_us;
    begun_ = true;
  }
  last_device_us_ = device_us;
  stale_ |= take_in(device_us, arrival_us);
  if (stale_ && (!frozen_ || first)) fit();

  const auto host_us = device_us + base_us_ + std::llround(line_at(device_us));
  held_back_us_ = last_host_us_ ? std::max<std::int64_t>(*last_host_us_ + 1 - host_us, 0) : 0;
  last_host_us_ = host_us + held_back_us_;
  return *last_host_us_;
}

void ClockMapping::restart() {
  const auto last_host_us = last_host_us_;
  const bool frozen = frozen_;
  *this = ClockMapping(window_us_);
  last_host_us_ = last_host_us;
  frozen_ = frozen;
}

std::optional<std::int64_t> ClockMapping::offset_us() const {
  if (!begun_) return std::nullopt;
  return base_us_ + std::llround(line_at(last_device_us_));
}

// Set back: a message cannot arrive before it was sent. Set ahead: nothing else makes every message
// come late from one moment on.
bool ClockMapping::host_clock_was_set(std::int64_t device_us, std::int64_t arrival_us) {
  const double excess = static_cast<double>(arrival_us - device_us - base_us_) - line_at(device_us);
  if (excess < -static_cast<double>(kClockStep)) return true;
  if (excess < static_cast<double>(kClockStep)) {
    late_ = false;
    return false;
  }
  if (!late_) late_since_us_ = device_us;
  late_ = true;
  return device_us - late_since_us_ > kLastingDelay;
}

// True where the points have changed.
bool ClockMapping::take_in(std::int64_t device_us, std::int64_t arrival_us) {
  const Point point{device_us, static_cast<double>(arrival_us - device_us - base_us_)};
  if (points_.empty() || device_us / stretch_us_ != points_.back().device_us / stretch_us_) {
    points_.push_back(point);
    while (points_.front().device_us < device_us - window_us_) points_.pop_front();
    return true;
  }
  // Within a stretch drift is a few us: the smaller difference is the better one.
  if (point.difference_us >= points_.back().difference_us) return false;
  points_.back() = point;
  return true;
}

void ClockMapping::fit() {
  stale_ = false;
  const auto lowest = std::min_element(
      points_.begin(), points_.end(),
      [](const Point& a, const Point& b) { return a.difference_us < b.difference_us; });
  reference_device_us_ = lowest->device_us;
  offset_ = lowest->difference_us;
  drift_ = 0;
  if (points_.back().device_us - points_.front().device_us < kShortestForDrift) return;

  const auto slope = [](const Point& a, const Point& b) {
    return (b.difference_us - a.difference_us) / static_cast<double>(b.device_us - a.device_us);
  };
  std::vector<Point> hull;  // lower, by Andrew's monotone chain
  for (const Point& point : points_) {
    while (hull.size() >= 2 &&
           slope(hull[hull.size() - 2], hull.back()) >= slope(hull.back(), point))
      hull.pop_back();
    hull.push_back(point);
  }
  const std::int64_t middle =
      points_.front().device_us + (points_.back().device_us - points_.front().device_us) / 2;
  std::size_t edge = 0;
  while (edge + 2 < hull.size() && hull[edge + 1].device_us < middle) ++edge;
  const double drift = slope(hull[edge], hull[edge + 1]);
  if (std::abs(drift) > kLargestDrift) return;
  drift_ = drift;
  reference_device_us_ = hull[edge].device_us;
  offset_ = hull[edge].difference_us;
}

double ClockMapping::line_at(std::int64_t device_us) const {
  return offset_ + drift_ * static_cast<double>(device_us - reference_device_us_);
}

}  // namespace arcstart
