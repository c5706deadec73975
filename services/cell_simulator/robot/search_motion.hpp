// The arm's program: the paper's search from one taught position to another, and back.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

#include "common/geometry.hpp"
#include "services/cell_simulator/robot/speed_profile.hpp"

namespace arcstart::cell_simulator {

struct SearchMotionSettings {
  double search_speed = 50;       // along the search; mm/s
  double return_speed = 500;      // back, and to a pose that was asked for; mm/s
  double acceleration = 1000;     // of every move; mm/s2
  double delay_after_scan = 0.5;  // a scan's begin to the search's begin, at least; s
  // Of further sweeps after the search, back to its begin, to its end again and so on; mm/s.
  std::vector<double> further_sweeps = {};
};

// Where the tool is at any time, as straight moves strung on the host's clock. What is asked for
// now begins 0.3 s later at the earliest, so that the pose is known 0.3 s ahead and frames can be
// rendered before they are due. Times in us, UTC. Safe to use from several threads.
class SearchMotion {
 public:
  static constexpr std::int64_t kNotice = 300'000;  // us

  // T_base_tool at both ends of the search; the arm stands at its begin.
  SearchMotion(const RigidTransform& begin, const RigidTransform& end,
               const SearchMotionSettings& settings);

  // A scan began: the arm goes to the search's begin where it is not there, and searches from the
  // first instant that is delay_after_scan after scan_begin, kNotice after now, not before it is
  // there, and lies `phase` (0..1) of a trigger period after a multiple of that period. Returns
  // that instant.
  std::int64_t search(std::int64_t now, std::int64_t scan_begin, std::int64_t trigger_period,
                      double phase);

  // The scan ended: a search that still runs is braked; then back to its begin.
  void go_back(std::int64_t now);

  // To a pose, and stay.
  void go_to(std::int64_t now, const RigidTransform& T_base_tool);

  RigidTransform pose(std::int64_t utime) const;  // T_base_tool
  bool moving(std::int64_t utime) const;
  std::int64_t at_rest_from(
      std::int64_t now) const;  // end of the last move, or now where that is past

 private:
  struct Move {
    std::int64_t start, end;  // us, UTC
    RigidTransform from, to;
    SpeedProfile profile;
    double length;  // of the way between them; mm

    RigidTransform pose(std::int64_t utime) const;
  };
  void go_to_begin(std::int64_t now);
  void cancel(std::int64_t now);
  void stop(std::int64_t now);
  void append(std::int64_t not_before, const RigidTransform& to, double speed);

  mutable std::mutex mutex_;
  SearchMotionSettings settings_;
  RigidTransform begin_, end_;
  std::deque<Move> moves_;  // never empty; each begins at or after the end of the one before
};

}  // namespace arcstart::cell_simulator
