// The tool's way through time (the paper's trajectory queue): the positions of the last seconds,
// ordered by time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "common/geometry.hpp"

namespace arcstart::reconstruction {

class TrajectoryQueue {
 public:
  // Stamps are judged against the stream alone: one farther than this from the last is a jump.
  static constexpr std::int64_t kJump = 10'000'000;  // us

  // keep: how long positions are kept, largest_gap: between two that may be interpolated; us.
  TrajectoryQueue(std::int64_t keep, std::int64_t largest_gap)
      : keep_(keep), largest_gap_(largest_gap) {}

  // The stream's next position. One whose stamp does not rise is dropped. So is a single jump; when
  // the position after it goes on from it, the two begin a new stream. Beside a disputed one (it is
  // not known whose it is) nothing is interpolated.
  void insert(std::int64_t utime, const RigidTransform& T_base_tool, bool disputed = false);

  enum class State {
    waiting,  // no later position has come yet
    found,
    none  // no position can be told, whatever comes
  };
  struct Lookup {
    State state = State::waiting;
    RigidTransform T_base_tool = RigidTransform::Identity();
    std::string reason;  // of none
  };
  // The tool at this time, interpolated between the last position not after it and the first after
  // it (Eq. 4 and 5, with the orientation). Never extrapolates. What comes later never changes an
  // answer other than `waiting`, but for positions no longer kept.
  Lookup at(std::int64_t utime) const;

  // Stamp of the newest position, nothing before the first.
  std::optional<std::int64_t> newest() const;

  std::int64_t dropped_going_back() const { return going_back_; }
  std::int64_t dropped_jumps() const { return jumps_; }

 private:
  struct Position {
    std::int64_t utime;
    RigidTransform T_base_tool;
    bool disputed;
  };
  void append(const Position& position);

  std::int64_t keep_, largest_gap_;
  std::deque<Position> positions_;  // stamps rise strictly
  bool has_dropped_ = false;        // positions at the front, for their age
  std::optional<Position> jump_;    // the last one that came was a jump
  std::int64_t going_back_ = 0, jumps_ = 0;
};

}  // namespace arcstart::reconstruction
