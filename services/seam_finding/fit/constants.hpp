// Numbers of the numerical methods that several rooms share. Behind the dash stands the source;
// "bench": none is known, scripts/bench seam judges the number.
#pragma once

#include <cstddef>

namespace arcstart::seam_finding {

struct FitConstants {
  // Deviations at which Tukey's biweight reaches 0 - 95 % efficient for normal noise (Huber and
  // Ronchetti, Robust Statistics).
  double tukey_limit = 4.685;
  // Standard deviation over the median of absolute values - 1 / 0.6745, the upper quartile of the
  // normal distribution (Huber and Ronchetti).
  double median_to_deviation = 1.4826;
  // Deviations beyond which a value is an outlier - the usual rule: 3 in 1000 of normal noise.
  double outlier = 3;
  // Deviations within which a point lies on a plane - 1 in 16,000 of normal noise lies beyond.
  double on_plane = 4;
  // Places, at least, of a line whose slope they show - its three parameters need three.
  int line_places = 4;
  // Passes of reweighting for a line - bench: rows lap, butt, v.
  int line_passes = 12;
  // Places from which a line's first guesses are drawn, two each, at most: with three in ten off
  // the line, every other guess is right - bounds the time.
  std::size_t line_starts = 24;
  // Share of the places, at least, that lie together on a line which least squares misses - bench:
  // with fewer, either of two lines may be the edge.
  double line_majority = 0.7;
  // Points, at least, of a plane that is fitted robustly - bench.
  std::size_t plane_points = 20;
  // Points summed in floats before doubles take over - keeps the sums good to a millionth.
  std::size_t sum_block = 1024;
};
inline constexpr FitConstants kFit;

}  // namespace arcstart::seam_finding
