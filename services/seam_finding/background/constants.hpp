// Numbers of the background. Behind the dash stands the source; "bench": none is known,
// scripts/bench seam judges the number (its table of the background above all).
#pragma once

#include <cstddef>

#include "services/seam_finding/cloud/constants.hpp"

namespace arcstart::seam_finding {

struct BackgroundConstants {
  // Tolerances above a plane that is the background, which belong to it - bench.
  double plane_heights = 5;
  // mm; width of a cell, at least; in stripe spacings; in steps along a stripe - bench.
  double least_cell = 4, cell_spacings = 1.5, cell_steps = 1.2;
  // Spread of a window across its stripes, in spacings - between that of two stripes, 0.5, and of
  // three, 0.82.
  double least_spread = 0.6;
  // Spacings that a point reaches where there is no plane - bench.
  double rough_spacings = 0.75;
  // Points of a cell that are looked at for the nearest one - bench.
  std::size_t nearest_crowd = 512;
  // mm; from the borders of a cell a point is safely in it - above the rounding of doubles.
  double within_cell = 1e-6;
  // Share of a face's points that lie in its plane as background - bench.
  double continues = 0.25;
};
inline constexpr BackgroundConstants kBackground;

}  // namespace arcstart::seam_finding
