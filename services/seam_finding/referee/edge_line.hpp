// The straight edge through the places where stripes leave a plate.
#pragma once

#include <optional>
#include <vector>

#include "services/seam_finding/referee/edge_evidence.hpp"

namespace arcstart::seam_finding {

// Where it meets the plate's border at the seam, outward from the claimed end; mm.
struct EdgeLine {
  double foot = 0, deviation = 0;  // standard
};

// Of the lines through two crossings and the square ones through one, that with the most crossings
// on it. Square where they do not say otherwise. Nothing without two, or where too many lie off it.
std::optional<EdgeLine> line_through(const std::vector<EdgeMark>& crossings);

}  // namespace arcstart::seam_finding
