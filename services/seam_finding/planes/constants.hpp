// Numbers of the search for planes. Behind the dash stands the source; "bench": none is known,
// scripts/bench seam judges the number.
#pragma once

#include <cstddef>

#include "services/seam_finding/cloud/constants.hpp"

namespace arcstart::seam_finding {

struct PlaneConstants {
  // Points after which a poor hypothesis is given up - bench.
  std::size_t first_look = 256;
  // Passes in which a face grows - bench.
  int growths = 5;
  // Points of a straight piece, and pieces of a stripe (the longest), at most - bound the work.
  std::size_t piece_points = 64, stripe_pieces = 64;
  // rad; between pieces of one plane, besides what their lengths leave open - bench.
  double parallel_pieces = 0.02;

  // Bins of the points' distances from the line - bounds the sorting.
  std::size_t bins = 1024;
  // Points, evenly taken, that show a plate's spread - bench.
  std::size_t spread_sample = 1024;
  // A plate's spread over the cloud's noise that is no roughness - bench.
  double roughness = 1.5;
  // A plate's extent within its plane over the noise, at least - bench.
  double least_extent = 3;
  // mm; a plate's plane is fitted to what lies so near the seam - as the setting refit_distance_mm
  // has it.
  double fit_reach = 60;
  // mm; a step of a fit that changes nothing any more - the noise leaves the height of a plane of
  // thousands of points uncertain by a hundred times as much.
  double settled = 1e-5;
  // mm; so far off, a point has no weight - above every limit.
  float far_off = 1e9f;

  // Deviations of its mean within which a strip lies on a line; but, of a point's noise, no less
  // than the second - bench.
  double strip_deviations = 2.5, strip_noise = 0.25;
  // mm from the line, and a share of the farthest strip's distance: between them the reflection's
  // shift is the greatest - bench.
  double nearest_shift = 3, farthest_shift = 0.7;
  // Ratio of the places tried there - bench.
  double shift_step = 1.2;
  // Strips by which a line must be better to show a shift - bench.
  double shift_shown = 2.4;
};
inline constexpr PlaneConstants kPlanes;

}  // namespace arcstart::seam_finding
