// Numbers of where a seam starts and ends. Behind the dash stands the source; "bench": none is
// known, scripts/bench seam judges the number.
#pragma once

#include <cstddef>

#include "services/seam_finding/coverage/constants.hpp"

namespace arcstart::seam_finding {

struct EndConstants {
  // Where a stripe leaves a plate.

  // px square to the edge; standard deviation of a stripe's last centre from where it is expected
  // before the edge - bench.
  double light_deviation = 0.2;
  // mm along the seam for each mm of a stripe: below it light fades slowly at the edge. And the px
  // that are added for each so much less - bench.
  double flat_crossing = 0.2, flat_deviation = 8;
  // mm; between points on an edge face, at least - bench.
  double least_drop = 0.5;
  // Points on an edge face, at most - bench.
  int most_on_cut = 20;
  // Of an edge face, mm along the seam for each mm of its depth, at most - bench.
  double cut_slant = 0.15;
  // mm; standard deviation of an edge face's place along the seam - bench.
  double cut_noise = 0.07;
  // mm; over such a way the noise of points leaves a direction known - bench.
  double direction_base = 3;
  // Steps that show the usual one - bench.
  std::size_t step_sample = 64;
  // Of a stripe, mm along the seam for each mm of its length, at least - bench.
  double least_slant = 0.05;

  // A plate's end edge.

  // mm; places on one edge agree so well along the seam - bench.
  double agree = 0.35;
  // mm; standard deviation of a place along the seam, at least; and places with that noise that
  // enter the estimate of the noise - bench.
  double least_place_noise = 0.015;
  int prior_places = 2;
  // mm; standard deviation of an edge, whatever the number of its places - bench.
  double edge_floor = 0.01;
  // px square to the edge; what all its places have in common: light ends over edges in many ways -
  // bench.
  double common_deviation = 0.1;
  // Along the seam for each mm away, of an edge, at most - cut up to 31 degrees.
  double steepest = 0.6;
  // Places on a slanting edge, at least - two lie on some edge always.
  int slope_places = 3;
  // Of a slanting edge's places, by how much they outweigh a square one's - one sharp place.
  double slanted = 0.7;
  // Times less do places scatter about a slope that they show plainly, and more before - bench.
  double plainly = 2;
  // Sharp places, at least, of an edge where none was expected - bench.
  int sharp_beyond = 2;
  // Standard deviation over the median of absolute values - the reciprocal of 0.6745, the upper
  // quartile of the normal distribution, rounded more than kFit.median_to_deviation.
  double rounded_median_to_deviation = 1.483;
  // mm; odds that plates are cut flush, 3 to 7, times the way over which others' edges scatter
  // about each other, 13, over the root of 2 pi; rounded - bench.
  double flush_odds = 2.3;

  // Between which stripes a plate ends.

  // Share of joints whose plates end together, and the mm over which the others' ends scatter about
  // each other - bench.
  double flush_share = 0.3, offsets = 40;
  // mm; half a stripe's width, over which it is seen where it falls - bench.
  double half_stripe = 0.15;
  // Share of possibilities that do not count - bench.
  double never = 0.01;
  // mm along the seam; a stripe shows a plate at the seam also where it leaves it so little before,
  // and a part of that for each mm before it - bench.
  double margin = 0.5, margin_slant = 0.5;

  // Crossing plates.

  // mm; what is higher over a plate hides it for certain - bench.
  double hides = 3;
  // mm; about another plate's edge, where a lone stripe's may be flush with it - bench.
  double flush_within = 0.6;
  // Standard deviations of the difference of two edges that may be one - bench.
  double same_edge = 2.5;
  // px; how well a stripe's last light is known - bench.
  double light_extent = 0.25;
  // Of `near`; a stripe that leaves a plate so near may not show it - bench.
  double unseen = 2;
  // Stripe spacings beyond the window, where several stripes may still show an edge - bench.
  double beyond = 3;
  // mm; beside an edge's places what is seen is the plate's own - bench.
  double beside_edge = 3;
  // mm; farther out than that, an edge outweighs a stripe that shows nothing there - bench.
  double farther_out = 5;

  // Parallel plates. Flat on the table a plate's edge is crossed by few stripes, at a small slant.

  // Of the variance of an edge that many would cross; and mm - bench: rows lap, butt, v.
  double parallel_factor = 2.25, parallel_floor = 0.08;
  // Of what shows a plate, over the distance that does - bench: rows lap, butt, v.
  double shortest_shown = 1.5;
  // Steps of an integral - none known.
  int integral_steps = 200;
};
inline constexpr EndConstants kEnds;

}  // namespace arcstart::seam_finding
