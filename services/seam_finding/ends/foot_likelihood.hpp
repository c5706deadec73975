// How likely the stripes' evidence is for each place where a plate may end at the seam.
#pragma once

#include <vector>

#include "services/seam_finding/ends/edge_hypotheses.hpp"
#include "services/seam_finding/ends/plate_evidence.hpp"

namespace arcstart::seam_finding {

struct FootLikelihood {
  std::vector<double> at;  // of each place of the grid, over exp(scale); not all zero
  double scale = 0;
  double deviation = 0;   // standard, of what all crossings of the edge have in common; mm
  double slope = 0;       // of the edge at the likeliest place
  bool occluded = false;  // most of its crossings are the outline of something before the plate
};

// A plate ends at a straight edge: how it crosses the seam, and at which slope, is what makes the
// evidence likely or not. It may be cut square, or at any slope up to the steepest; the likelihood
// is the mean over slopes, and over how rough the edge is. Where what is seen beside the seam
// speaks against the edge, the plate's corner may be cut out there (a cope hole): then it ends
// farther in.
FootLikelihood foot_likelihood(const std::vector<StripeEvidence>& evidence, const PlaceGrid& grid,
                               const SquareEdge& square);

}  // namespace arcstart::seam_finding
