// The edges that a plate may end at.
#pragma once

#include <vector>

#include "services/seam_finding/ends/plate_evidence.hpp"

namespace arcstart::seam_finding {

// Places along the seam, outward: first, first + step, ...; mm.
struct PlaceGrid {
  double first = 0, step = 0;
  int count = 0;

  double at(double index) const { return first + step * index; }
};

// A slope that the edge may have, along for each mm away, how rough it may be there, mm, and the
// probability of both.
struct Hypothesis {
  double roughness = 0, weight = 0;
};
struct Slope {
  double slope = 0;
  std::vector<Hypothesis> hypotheses;
};

// The slope of an edge that is cut square, and how well (standard deviation): along for each mm
// away.
struct SquareEdge {
  double slope = 0, deviation = 0;
};

// Square, those that crossings tell, and some that stand for all up to the steepest.
std::vector<Slope> slopes_of(const std::vector<StripeEvidence>& evidence, const PlaceGrid& grid,
                             const SquareEdge& square);

// How far a stripe comes outward of an edge at a slope, along the seam, for each mm that it goes on
// behind the crossing. Where that is less than `kEnds.least_slant` it does not leave the plate over
// such an edge there, or runs along it.
double leaving(const EdgeCrossing& edge, double slope);

// Of the foot of an edge at a slope through one crossing; mm2.
double variance_of(const EdgeCrossing& edge, double slope, double roughness);

}  // namespace arcstart::seam_finding
