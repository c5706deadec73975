// Lines found at several scales, each place of a line kept at the scale that shows it best.
#pragma once

#include <vector>

#include "services/extraction/image/frame_arena.hpp"
#include "services/extraction/lines/linking.hpp"
#include "services/extraction/ridge/ridge_point.hpp"

namespace arcstart::extraction {

// Points and chains of all scales together.
struct ScaledLines {
  std::vector<RidgePoint> points;  // curvature: such that factor times it is the strength
  std::vector<float> sigmas;       // of the kernels that found each; px
  std::vector<Chain> chains;

  void clear();
  // Adds what was found at sigma. strength: of a curvature there; factor: of one in points.
  void add(const std::vector<RidgePoint>& found, const std::vector<Chain>& found_chains,
           double sigma, double strength, double factor, Memory memory);
};

// Strength is greatest at the line's own width. So where chains of two scales lie on one another,
// within the wider kernels' sigma and in like direction, the weaker one's points are taken out of
// its chain; strength is the mean over some of the chain, or speckle would change the scale at
// every second point. What is left of a chain becomes chains of fewest_points and more.
void keep_best_scale(ScaledLines& lines, int fewest_points, Memory memory);

}  // namespace arcstart::extraction
