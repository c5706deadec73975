// Where a seam ends, from where each of its two plates may.
#pragma once

#include <array>
#include <vector>

#include "services/seam_finding/ends/foot_likelihood.hpp"

namespace arcstart::seam_finding {

// A connected stretch of places where the seam may end.
struct EndMode {
  double out = 0, variance = 0;  // mean; mm, mm2
  double weight = 0;             // probability
};

// The seam ends where the first of its plates does: they are cut flush, or the one ends anywhere
// about the other's end. The modes, likeliest first; what is missing of their weights lies beyond
// the grid.
std::vector<EndMode> seam_end_modes(const std::array<FootLikelihood, 2>& plates,
                                    const PlaceGrid& grid);

}  // namespace arcstart::seam_finding
