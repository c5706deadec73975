// Numbers of the background. Behind the dash stands the source; "bench": none is known,
// scripts/bench seam judges the number (its table of the background above all).
#pragma once

#include "services/seam_finding/cloud/constants.hpp"

namespace arcstart::seam_finding {

struct BackgroundConstants {
  // Tolerances above a plane that is the background, which belong to it - bench.
  double plane_heights = 5;
  // mm; width of a cell, at least; in spacings of stripes or steps along them - bench.
  double least_cell = 4, cell_spacings = 1.5;
  // Spread of a window across its stripes, in spacings - between that of two stripes, 0.5, and of
  // three, 0.82.
  double least_spread = 0.6;
  // Share of a face's points that lie in its plane as background - bench.
  double continues = 0.25;
};
inline constexpr BackgroundConstants kBackground;

}  // namespace arcstart::seam_finding
