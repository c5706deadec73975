// Numbers of what can be seen of a plate, beside it and past it. Behind the dash stands the source;
// "bench": none is known, scripts/bench seam judges the number.
#pragma once

#include <cstddef>

#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {

struct VisibilityConstants {
  // mm; so near the seam it may be the joint's other plate that is seen, and stripes turn into it;
  // so near a plate's far edge it may be that edge that a stripe leaves it by - bench.
  double near_seam = 3;
  // A point's noise along the seam over that across its surface - bench.
  double beam = 0.5;
  // Sine of the angle between a line of sight and a plate, at least - bench.
  double least_sight = 0.1;

  // What lies in a plate rises from it by no more, mm for each mm, and deviations for its noise -
  // bench: row glare.
  double rise = 0.04, sure_rise = 2.5;
  // mm; what is longer does lie in it - bench: row glare.
  double long_piece = 15;

  // 1/mm; of a plate along the seam: 1 mm in 100, up and down - twice what plates are bent.
  double most_curved = 8e-4;
  // 1/mm; below it a plate of 200 mm leaves its plane by a quarter of a tolerance - bench: wild.
  double least_curved = 1.5e-5;
  // mm; from its plane, of a bent plate - 1 mm in 100, over 250.
  double most_bent = 2.5;
  // mm; from the seam, what shows the bend - its middle.
  double bend_reach = 40;
  // Points, at least, that tell a bend; of the scan so many are looked at, for speed; and passes,
  // by which the bend is followed outward - bench.
  std::size_t bend_points = 50, bend_sample = 5000;
  int bend_passes = 4;
  // Of the noise; a bent plate's points are no farther from its bend, on average - bench: wild.
  double bend_noises = 2;

  // mm; from the seam another thing may touch the plate, as high - bench: row box_on_base.
  double farthest = 55;
  // mm; light that falls past a plate is so wide, spatter is not - bench: row glare.
  double least_fall = 12;
  // mm; between the places where light and sight meet the plane, at most - bench.
  double askew = 5;

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
