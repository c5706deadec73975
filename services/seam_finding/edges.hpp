// The edges at which a plate begins and ends along a seam, from where the stripes leave it.
#pragma once

#include <limits>
#include <optional>

#include "services/seam_finding/plate_stripes.hpp"

namespace arcstart {

enum class SeamSide { kBegin = -1, kEnd = 1 };

struct EdgeSearch {
  double from = 0, to = 0;   // along the line, where the edge may cross it; mm
  double beyond = 0;         // so much farther if several stripes tell the same
  double tolerance = 0.5;    // of a point's distance from its plate; mm
  double noise = 0.05;       // of the points across their surface, standard deviation; mm
  double shortening_px = 0;  // a stripe's last centre lies so far before the edge, square to it
  double slope = 0.001;      // of a plate's edge, standard deviation; mm along for each mm away
};

struct PlateEdge {
  double along = 0;     // where it crosses the seam; mm
  double variance = 0;  // mm2
  double away = 0;      // from the seam, of the mean of the places that tell it; mm
  double pixel = 0;     // what one square to the edge is along the seam, their mean; mm
  // And of the farthest, where at least two stripes clearly end there; infinite otherwise.
  double clear_to = std::numeric_limits<double>::infinity();
  int stripes = 0;        // that leave the plate over it
  bool occluded = false;  // what is seen is the outline of something before the plate
};

// Stripes cross the seam at a slant, so several of them leave a plate over the edge at its begin,
// each at another distance from the seam, and each known to a pixel however few of its inner points
// are kept. The edge is the line through these places; a plate is cut square unless they say
// otherwise. Nothing where no stripe leaves the plate there, and in a cloud without stripes.
std::optional<PlateEdge> find_edge(const ScanCloud& cloud, const PlateStripes& stripes,
                                   SeamSide side, const EdgeSearch& search);

// Where on a line, from within its two plates outward, not both are there any more.
struct CommonEnd {
  double along = 0, variance = 0;  // mm, mm2
};

// Of plates whose edges are given. They are flush, or the one ends first; how near their edges lie
// to each other, for what is known of them, says how likely either is, and both enter with that
// share.
CommonEnd end_of_both(const PlateEdge& a, const PlateEdge& b, SeamSide side);

}  // namespace arcstart
