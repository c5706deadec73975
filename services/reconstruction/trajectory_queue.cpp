#include "services/reconstruction/trajectory_queue.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

namespace arcstart::reconstruction {

void TrajectoryQueue::insert(std::int64_t utime, const RigidTransform& T_base_tool, bool disputed) {
  const Position position{utime, T_base_tool, disputed};
  if (positions_.empty()) return append(position);
  const std::int64_t last = positions_.back().utime;
  if (std::abs(utime - last) > kJump) {
    const bool goes_on = jump_ && utime > jump_->utime && utime - jump_->utime <= kJump;
    if (!goes_on) {
      if (jump_) ++jumps_;
      jump_ = position;
      return;
    }
    // A new stream. One that lies behind leaves nothing to interpolate in the old one; one ahead
    // joins on, so that stripes in the hole between the two are told how long it is.
    if (utime < last) {
      positions_.clear();
      has_dropped_ = false;
    }
    append(*jump_);
    jump_.reset();
    return append(position);
  }
  if (jump_) ++jumps_;
  jump_.reset();
  if (utime <= last) {
    ++going_back_;
    return;
  }
  append(position);
}

void TrajectoryQueue::append(const Position& position) {
  positions_.push_back(position);
  // The last position before the time kept stays: a stripe between it and the next still finds
  // both.
  while (positions_.size() > 2 && position.utime - positions_[1].utime >= keep_) {
    positions_.pop_front();
    has_dropped_ = true;
  }
}

TrajectoryQueue::Lookup TrajectoryQueue::at(std::int64_t utime) const {
  const auto later = std::upper_bound(
      positions_.begin(), positions_.end(), utime,
      [](std::int64_t time, const Position& position) { return time < position.utime; });
  if (later == positions_.end()) return {};
  Lookup lookup;
  lookup.state = State::none;
  if (later == positions_.begin()) {
    lookup.reason = has_dropped_ ? fmt::format("its position is no longer kept ({} s)", keep_ / 1e6)
                                 : "no position before it";
    return lookup;
  }
  const auto earlier = std::prev(later);
  const std::int64_t gap = later->utime - earlier->utime;
  if (gap > largest_gap_) {
    lookup.reason = fmt::format("positions {:.0f} ms apart", static_cast<double>(gap) / 1e3);
    return lookup;
  }
  if (earlier->disputed || later->disputed) {
    lookup.reason = "the positions come from two senders";
    return lookup;
  }
  lookup.state = State::found;
  lookup.T_base_tool =
      interpolate(earlier->T_base_tool, later->T_base_tool,
                  static_cast<double>(utime - earlier->utime) / static_cast<double>(gap));
  return lookup;
}

std::optional<std::int64_t> TrajectoryQueue::newest() const {
  if (positions_.empty()) return std::nullopt;
  return positions_.back().utime;
}

}  // namespace arcstart::reconstruction
