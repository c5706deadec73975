// Numbers of where along a seam both plates are there. Behind the dash stands the source; "bench":
// none is known, scripts/bench seam judges the number.
#pragma once

#include "services/seam_finding/visibility/constants.hpp"

namespace arcstart::seam_finding {

struct CoverageConstants {
  // mm; points so near the line show how the stripes cross it - bench.
  double slant_reach = 15;
  // That slant at most, mm along the line for each mm away from it - bench.
  double steepest = 3;
  // Steps from a stripe's last point to the line, at most: one point may be missing - bench.
  double steps_to_line = 2.15;
  // And to a plate's edge, of parallel plates, where none may - bench: rows lap, butt, v.
  double steps_to_edge = 1.2;
  // mm; but no less than this, for a stripe's end is lost before an edge - bench: rows lap, butt,
  // v.
  double least_slack = 1;
  // mm; a seam and its plates go on behind an interruption that is no longer - bench.
  double bridge = 20;
  // Stripe spacings to a lone stripe that is part of the seam, at most - one stripe may lie
  // between.
  double lone_gap = 2.5;
  // Of the spacing; stripes that are nearer to each other were taken at a standstill - bench.
  double same_place = 0.3;
};
inline constexpr CoverageConstants kCoverage;

}  // namespace arcstart::seam_finding
