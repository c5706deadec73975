// Between which places a plate's end at the seam lies by what the stripes show of it, whatever the
// answer says.
#pragma once

#include <limits>

#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/referee/plate_view.hpp"

namespace arcstart::seam_finding {

// Counted outward from the claimed end; mm.
struct EndBounds {
  // The plate is there beside the seam on a run of stripes within the claim: else nothing is known.
  bool anchored = false;
  double least = -std::numeric_limits<double>::infinity();  // the plate reaches so far, at least
  double most = std::numeric_limits<double>::infinity();    // and no farther
  bool straight = true;  // its edge, as far as it was crossed; else what is beside the seam tells
  int crossings = 0;     // stripes that leave the plate over its edge
};

// along: the seam, of the claimed end. spacing: of the stripes along the seam; mm.
EndBounds bounds_of(const PlateView& view, SeamSide side, double along, double spacing);

// Of the seam, which ends where the first of its plates does.
EndBounds first_of(const EndBounds& a, const EndBounds& b);

}  // namespace arcstart::seam_finding
