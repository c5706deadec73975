// Numbers of what is measured on a cloud itself. Behind the dash stands the source; "bench": none
// is known, scripts/bench seam judges the number. Sample sizes bound the time, too.
#pragma once

#include <cstddef>

#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {

struct CloudConstants {
  // Points or values, evenly taken, that serve for all of them - bench.
  std::size_t sample = 4096;
  // Those of a cloud without stripes that serve for its noise: it may show its plates here and
  // there alone - bench.
  std::size_t loose_sample = 16384;
  // Points, evenly taken, about which neighbours are looked at: for their distances, for outliers
  // where there are many, for the noise - bench.
  std::size_t places = 256;
  // Neighbours by which the spacing is measured - a square grid has eight around a point.
  int neighbours = 8;
  // Points of a cell that are looked at - bench.
  std::size_t crowd = 256;
  // mm; a point's distance from its plane, at least and at most, where the noise sets it - bench.
  double least_tolerance = 0.6, most_tolerance = 6;
  // mm; way in a stripe over which errors do not depend on each other: ten pixels. Points nearer to
  // each other tell the search no more - bench: wild.
  double independent = 1.5;
  // How much more points scatter between stripes than in them, at most: positions err, too - bench:
  // wild.
  double between_stripes = 3;
  // mm; below this the noise cannot be measured - bench.
  double least_noise = 0.01;
  // Steps along a stripe, of a way on which there is one point more surely than two - bench: rows
  // m1, m5, m20.
  double one_step = 1.3;
  // Cells on either side of the origin - 21 bits an axis make 63 of a 64-bit key.
  int cell_bias = 1 << 20;
  // Cells of a box for each point, up to which the box is kept whole - none known; it trades memory
  // for time.
  double box_cells = 16;
  // Points whose distances from a plane are taken side by side - none known.
  std::size_t distance_block = 64;
};
inline constexpr CloudConstants kCloud;

}  // namespace arcstart::seam_finding
