#include "services/cell_simulator/robot/search_motion.hpp"

#include <algorithm>
#include <cmath>

#include "common/time.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::size_t kMovesKept = 32;
constexpr double kSamePlace = 1e-6;  // mm

double seconds(std::int64_t us) { return static_cast<double>(us) * 1e-6; }

// A turn counts as the way of a point 300 mm from the tool centre point, so that a mere turn takes
// its time too.
double way(const RigidTransform& from, const RigidTransform& to) {
  constexpr double kArm = 300;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(from.linear().transpose() * to.linear()));
  return std::max((to.translation() - from.translation()).norm(), kArm * std::abs(turn.angle()));
}

}  // namespace

RigidTransform SearchMotion::Move::pose(std::int64_t utime) const {
  if (utime >= end) return to;
  return interpolate(from, to, profile.distance(seconds(utime - start)) / length);
}

SearchMotion::SearchMotion(const RigidTransform& begin, const RigidTransform& end,
                           const SearchMotionSettings& settings)
    : settings_(settings), begin_(begin), end_(end) {
  moves_.push_back({0, 0, begin, begin, {}, 0});
}

std::int64_t SearchMotion::search(std::int64_t now, std::int64_t scan_begin,
                                  std::int64_t trigger_period, double phase) {
  const std::lock_guard lock(mutex_);
  go_to_begin(now);
  const std::int64_t earliest = std::max(
      {scan_begin + seconds_to_us(settings_.delay_after_scan), now + kNotice, moves_.back().end});
  const auto offset = std::llround(phase * static_cast<double>(trigger_period));
  const std::int64_t late = (earliest - offset) % trigger_period;
  const std::int64_t start = late == 0 ? earliest : earliest + trigger_period - late;
  append(start, end_, settings_.search_speed);
  bool back = true;
  for (const double speed : settings_.further_sweeps) {
    append(start, back ? begin_ : end_, speed);
    back = !back;
  }
  return start;
}

void SearchMotion::go_back(std::int64_t now) {
  const std::lock_guard lock(mutex_);
  go_to_begin(now);
}

void SearchMotion::go_to(std::int64_t now, const RigidTransform& T_base_tool) {
  const std::lock_guard lock(mutex_);
  stop(now);
  append(now + kNotice, T_base_tool, settings_.return_speed);
}

// An arm that stands there, or is on its way, is left alone.
void SearchMotion::go_to_begin(std::int64_t now) {
  cancel(now);
  if (way(moves_.back().to, begin_) < kSamePlace) return;
  stop(now);
  append(now + kNotice, begin_, settings_.return_speed);
}

// What has not begun within the notice.
void SearchMotion::cancel(std::int64_t now) {
  while (moves_.size() > 1 && moves_.back().start >= now + kNotice) moves_.pop_back();
}

// Cancels, and brakes what runs then.
void SearchMotion::stop(std::int64_t now) {
  const std::int64_t when = now + kNotice;
  cancel(now);
  Move& last = moves_.back();
  if (last.end <= when) return;
  const double time = seconds(when - last.start);
  const double speed = last.profile.speed(time);
  const SpeedProfile braking = SpeedProfile::brake(speed, settings_.acceleration);
  const double stands_at = last.profile.distance(time) + braking.length();
  if (stands_at >= last.length - 1e-9) return;  // it slows down already
  const RigidTransform from = last.pose(when);
  const RigidTransform to = interpolate(last.from, last.to, stands_at / last.length);
  last.end = when;  // until then it runs as before; afterwards the braking is asked
  moves_.push_back(
      {when, when + seconds_to_us(braking.duration()), from, to, braking, braking.length()});
}

void SearchMotion::append(std::int64_t not_before, const RigidTransform& to, double speed) {
  const RigidTransform from = moves_.back().to;
  const double length = way(from, to);
  if (length < kSamePlace) return;
  const SpeedProfile profile = SpeedProfile::travel(length, speed, settings_.acceleration);
  const std::int64_t start = std::max(not_before, moves_.back().end);
  moves_.push_back({start, start + seconds_to_us(profile.duration()), from, to, profile, length});
  while (moves_.size() > kMovesKept) moves_.pop_front();
}

RigidTransform SearchMotion::pose(std::int64_t utime) const {
  const std::lock_guard lock(mutex_);
  const auto move = std::find_if(moves_.rbegin(), moves_.rend(),
                                 [utime](const Move& m) { return m.start <= utime; });
  return move == moves_.rend() ? moves_.front().from : move->pose(utime);
}

bool SearchMotion::moving(std::int64_t utime) const {
  const std::lock_guard lock(mutex_);
  return std::any_of(moves_.begin(), moves_.end(),
                     [utime](const Move& m) { return m.start <= utime && utime < m.end; });
}

std::int64_t SearchMotion::at_rest_from(std::int64_t now) const {
  const std::lock_guard lock(mutex_);
  return std::max(now, moves_.back().end);
}

}  // namespace arcstart::cell_simulator
