// Numbers that say what stripes show, for all rooms. Behind the dash stands the source; "bench":
// none is known, scripts/bench seam judges the number.
#pragma once

#include "services/seam_finding/fit/constants.hpp"

namespace arcstart::seam_finding {

struct ModelConstants {
  // Points of a stripe, at least, that chance does not put side by side on a surface, or off it -
  // bench.
  int sure_points = 3;
  // Points, at least, that chance does not put behind a plate or onto a bead - bench.
  int sure_off_plate = 2;
  // Places in a stripe between points of one piece, at most: outliers do not part it - bench.
  int gap_places = 3;
  // Stripes in a row that are not lost or spoilt by accident - bench: row lost.
  int stripes_in_a_row = 3;
  // Stripes, at least, by which a plane is known - two fix it, the third bears it out.
  int plane_stripes = 3;
  // mm; way of the tool, at least, that says where the search goes - bench.
  double least_motion = 5;
  // mm; from the line of a seam between crossing plates, what is judged with it - bench.
  double beside_seam = 25;
  // mm; from the seam, up to where a plate may be taken for straight - bench.
  double straight_beside = 20;
};
inline constexpr ModelConstants kModel;

}  // namespace arcstart::seam_finding
