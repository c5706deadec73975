// Numbers of what can be seen of a plate, beside it and past it. Behind the dash stands the source;
// "bench": none is known, scripts/bench seam judges the number.
#pragma once

#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {

struct VisibilityConstants {
  // mm; so near the seam it may be the joint's other plate that is seen, and stripes turn into it -
  // bench.
  double near_seam = 3;
  // mm; so near a plate's far edge it may be that edge that a stripe leaves it by - bench.
  double far_edge = 3;
  // A plate end's slope, mm along the seam for each mm away from it, at most - bench.
  double end_slope = 0.01;
  // A point's noise along the seam over that across its surface - bench.
  double beam = 0.5;
  // Sine of the angle between a line of sight and a plate, at least - bench.
  double least_sight = 0.1;

  // mm; between points on one piece of a plate, at most - bench.
  double piece_gap = 4;
  // What lies in a plate rises from it by no more, mm for each mm, and deviations for its noise -
  // bench: row glare.
  double rise = 0.04, sure_rise = 2.5;
  // mm; what is longer does lie in it - bench: row glare.
  double long_piece = 15;

  // mm; from the seam another thing may touch the plate, as high - bench: row box_on_base.
  double farthest = 55;
  // mm; a plate seen so far beyond the seam's end may be another thing as high - bench.
  double goes_on = 5;
  // mm; light that falls past a plate is so wide, spatter is not - bench: row glare.
  double least_fall = 12;
  // mm; so far before others a lone stripe sees a reflection, not past the plate - bench.
  double lone_stripe = 12;
  // mm; from the seam, that other thing lies no nearer - bench: row box_on_base.
  double close = 30;
  // mm; between the places where light and sight meet the plane, at most - bench.
  double askew = 5;
  // mm; along the seam between neighbours in a row, at most - bench.
  double row_step = 1.5;
  // mm; from the end, the stripes that show where it is - bench.
  double around_end = 40;

  // mm; what stands before a seam lies so near it - bench: rows tool, tool_block.
  double before_reach = 60;
  // mm; what is higher over both plates stands before them - bench.
  double stands_before = 2;
  // What a thing hides beside it: mm for each mm of its height, and mm - bench.
  double hidden_slope = 1.2, hidden_beside = 3;
  // Stripes of which one that shows something past a plate shows a reflection - bench.
  int lone_reflection = 4;
};
inline constexpr VisibilityConstants kVisibility;

}  // namespace arcstart::seam_finding
