// The straight edges that the fewest stripes contradict.
#pragma once

#include <limits>
#include <vector>

#include "services/seam_finding/referee/edge_evidence.hpp"

namespace arcstart::seam_finding {

// Between which places the edge meets the seam, outward from the claimed end; mm.
struct EdgeFoot {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  // As `most`, were the stripe that says so not there.
  double most_but_one = std::numeric_limits<double>::infinity();
};

struct EdgeFit {
  EdgeFoot foot;             // of all slopes up to the steepest together
  double contradicting = 0;  // stripes that no edge can satisfy; dark ones count less
  int crossings = 0;         // stripes that leave the plate over the edge
};

// Every place may be off by `play`; mm.
EdgeFit fit_edge(const std::vector<EdgeEvidence>& all, double play);

// An edge as straight as it is found to be: while more than one stripe contradicts it, waves of a
// flame's cut are allowed, and the foot may be off by as much.
EdgeFit fit_waved_edge(const std::vector<EdgeEvidence>& all);

}  // namespace arcstart::seam_finding
