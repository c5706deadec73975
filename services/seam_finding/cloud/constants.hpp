// Numbers of what is measured on a cloud itself. Behind the dash stands the source; "bench": none
// is known, scripts/bench seam judges the number. Sample sizes bound the time, too.
#pragma once

#include <cstddef>

#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {

struct CloudConstants {
  // Points or values, evenly taken, that serve for all of them - bench.
  std::size_t sample = 4096, small_sample = 2048;
  // Points, evenly taken, by whose neighbours outliers are recognised where there are many - bench.
  std::size_t outlier_sample = 512;
  // Places where the distance of points is measured, and where their noise is - bench.
  int spacing_places = 400, noise_places = 200;
  // Neighbours by which the spacing is measured - a square grid has eight around a point.
  int neighbours = 8;
  // Points that serve for the noise, of a cloud of more than twice as many; one without stripes may
  // show its plates here and there alone - bench.
  int noise_points = 2500, loose_noise_points = 16384;
  // Points of a cell that are looked at, for neighbours and for the noise - bench.
  std::size_t crowd = 256, noise_crowd = 64;
  // mm; between points of a stripe that are kept for the search - bench.
  double thinned_step = 1.5;
  // mm; a point's distance from its plane, at least and at most, where the noise sets it - bench.
  double least_tolerance = 0.6, most_tolerance = 6;
  // mm; way in a stripe over which errors do not depend on each other: ten pixels. And how much
  // more points scatter between stripes than in them, at most: positions err, too - bench: wild.
  double chord = 1.5, between_stripes = 3;
  // mm; below this the noise cannot be measured - bench.
  double least_noise = 0.01;
  // Contact over the points' distance along a stripe - bench: rows m1, m5, m20.
  double contact_pitches = 1.3;
  // Cells on either side of the origin - 21 bits an axis make 63 of a 64-bit key.
  int cell_bias = 1 << 20;
  // Slots of a hash table at first, a power of two - any of them serves.
  std::size_t first_slots = 256;
  // Cells of a box for each point, up to which the box is kept whole - none known; it trades memory
  // for time.
  double box_cells = 16;
  // Points whose distances from a plane are taken side by side - none known.
  std::size_t distance_block = 64;
};
inline constexpr CloudConstants kCloud;

}  // namespace arcstart::seam_finding
