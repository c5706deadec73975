// The edges at which a plate begins and ends along a seam, from where the stripes leave it.
#pragma once

#include <limits>
#include <optional>

#include "services/seam_finding/ends/edge_crossing.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/visibility/plate_stripes.hpp"

namespace arcstart::seam_finding {

// Along the seam's line, where an edge may cross it; mm.
struct EdgeWindow {
  double from = 0, to = 0;
  double beyond = 0;  // so much farther if several stripes tell the same
};

// Stripes cross the seam at a slant, so several of them leave a plate over the edge at its begin,
// each at another distance from the seam, and each known to a pixel however few of its inner points
// are kept. The edge is the line through these places; a plate is cut square unless they say
// otherwise. Nothing where no stripe leaves the plate there, and in a cloud without stripes.
std::optional<PlateEdge> find_edge(const ScanCloud& cloud, const PlateStripes& stripes,
                                   SeamSide side, const EdgeWindow& window, const Scales& scales,
                                   const SeamFindingSettings& settings);

// Where on a line, from within its two plates outward, not both are there any more.
struct CommonEnd {
  double along = 0, variance = 0;  // mm, mm2
};

// Of plates whose edges are given. They are flush, or the one ends first; how near their edges lie
// to each other, for what is known of them, says how likely either is, and both enter with that
// share.
CommonEnd end_of_both(const PlateEdge& a, const PlateEdge& b, SeamSide side);

}  // namespace arcstart::seam_finding
