// Numbers that say what stripes show, for all rooms. Behind the dash stands the source; "bench":
// none is known, scripts/bench seam judges the number.
#pragma once

#include "services/seam_finding/fit/constants.hpp"

namespace arcstart::seam_finding {

struct ModelConstants {
  // Points of a stripe, at least, that chance does not put side by side on a surface, or off it;
  // and as many places farther on it may be the same piece: outliers between do not part it -
  // bench.
  int sure_points = 3;
  // Points, at least, that chance does not put behind a plate or onto a bead - bench.
  int sure_off_plate = 2;
  // Stripes, at least, that do not show the same by accident: in a row lost or spoilt, or on a
  // plane, which two fix and the third bears out - bench: row lost.
  int stripes_in_a_row = 3;
  // mm; way of the tool, at least, that says where the search goes - bench.
  double least_motion = 5;
  // mm; from the line of a seam, what is judged with it, and a plate may be taken for straight -
  // bench.
  double beside_seam = 25;
  // mm; as wide as the cut of the thickest plate, of 20 mm, and its edge's place.
  double widest_cut = 22;
  // mm; from the seam's line, where a round edge begins, at most - the largest outside radius of a
  // cold-formed section of 6 mm, 2.4 times its wall (EN 10219-2), and a gap.
  double widest_round = 18;
  // Of an edge, mm along the seam for each mm away, at most - cut up to 31 degrees.
  double steepest_edge = 0.6;
  // mm; between places of a stripe on one piece of a plate, at most - bench: dropouts, M of 15.
  double piece_gap = 4;
};
inline constexpr ModelConstants kModel;

}  // namespace arcstart::seam_finding
