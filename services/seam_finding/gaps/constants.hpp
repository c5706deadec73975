// Numbers of the gaps between plates. Behind the dash stands the source; "bench": none is known,
// scripts/bench seam judges the number.
#pragma once

#include <cstddef>

#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {

struct GapConstants {
  // Root gap of a tee, a corner or a lap: the bench's row is root_gap.

  // mm; points so near the corner are looked at - bench.
  double reach = 10;
  // mm; the widest gap - bench, which measures gaps up to 4 mm.
  double widest = 6;
  // mm; of a point from a plate's plane, at most - bench.
  double on_plate = 0.5;
  // mm; a stripe that comes from so far on a plate is on it - bench.
  double clear = 1;
  // px; so far behind a turn the stripe is where its surface is - bench.
  double turn = 8;
  // px^2; standard deviation of the area by what reflections make of it - bench.
  double area_deviation = 7;
  // mm; standard deviation of a gap by a segment's end near another - bench.
  double parted_deviation = 0.2;
  // mm; of the plate that goes on, seen behind the other's face, at least - bench.
  double least_behind = 0.3;
  // mm that is seen of it for each mm of gap, at least - bench.
  double flattest = 0.2;
  // Of the thinning: two steps in one, so that a point between them is kept - bench.
  double kept_steps = 1.3;
  // Points that show the thinning - bench.
  std::size_t thinning_sample = 4000;
  // px; centres so near each other show the corner in any case - bench.
  double fine = 3;

  // Gap of a butt joint that no stripe shows alone: the bench's row is butt.

  // Places that are fitted, at most - bounds the time.
  std::size_t most_places = 500;
  // Passes of the fit - bench.
  int passes = 25;
  // A height counts nothing that is off by more than this much of the deepest place - bench.
  double outlier_share = 1.2;
  // mm; standard deviation by which the light is smoothed: least, at first, most - bench.
  double least_rounding = 0.02, rounding = 0.4, most_rounding = 1;
  // mm; the narrowest gap - bench.
  double least_width = 0.1;
  // From the joint's slope, at most - bench.
  double most_slope = 0.1;
  // Slopes and widths (mm) at which the fit starts - bench.
  double slopes[4] = {-0.02, -0.007, 0.007, 0.02}, widths[3] = {0.6, 1, 1.8};
  // Of what the heights differ from a plate without a gap, what the fit may leave - bench.
  double most_left = 0.5;
  // mm; the difference by which derivatives are taken - bench.
  double difference = 1e-4;
};
inline constexpr GapConstants kGaps;

}  // namespace arcstart::seam_finding
