// Where a plate, and the seam between two, begins or ends.
#pragma once

#include <limits>

namespace arcstart::seam_finding {

enum class SeamSide { kBegin = -1, kEnd = 1 };

enum class EndVisibility { kNotDetermined, kSeen, kHidden, kOutside };

struct SeamEnd {
  double along = 0;     // along the seam's line; mm
  double variance = 0;  // of it; mm2
  EndVisibility visibility = EndVisibility::kNotDetermined;
  bool by_edges = false;  // else known to half the distance of two stripes
};

struct PlateEdge {
  double along = 0;     // where it crosses the seam; mm
  double slope = 0;     // along the seam for each mm away from it, where it is not cut square
  double variance = 0;  // mm2
  double away = 0;      // from the seam, of the mean of the places that tell it; mm
  double pixel = 0;     // what one square to the edge is along the seam, their mean; mm
  // And of the farthest, where at least two stripes clearly end there; infinite otherwise.
  double clear_to = std::numeric_limits<double>::infinity();
  int stripes = 0;        // that leave the plate over it
  bool occluded = false;  // what is seen is the outline of something before the plate
};

// Counted outward: along the line toward the side that is looked at; mm.
struct PlateExtent {
  double on = -std::numeric_limits<double>::infinity();   // the plate is there
  double past = std::numeric_limits<double>::infinity();  // something was seen through there
};

}  // namespace arcstart::seam_finding
