// What one stripe says of the edge at which a plate ends along the seam.
#pragma once

#include <vector>

#include "services/seam_finding/referee/plate_view.hpp"

namespace arcstart::seam_finding {

struct ClaimedEnd {
  double along = 0;    // the seam; mm
  double outward = 1;  // 1 at the seam's end, -1 at its start

  double out(double along_seam) const { return outward * (along_seam - along); }
};

// A place that the plate must reach, or must not: outward from the claimed end, and away from the
// plate's border at the seam; mm.
struct EdgeMark {
  double out, away;
};

// A straight edge has all of `on` on its inner side and all of `off` on its outer one. Of each the
// extremes are enough. `dark`: where the plate would be lit and nothing was seen, though nothing
// stands before it; it says less than what lies behind.
struct EdgeEvidence {
  std::vector<EdgeMark> on, off, dark;
  bool crosses() const { return !on.empty() && !(off.empty() && dark.empty()); }
};

// From the stripe's places up to `width` from where the plate begins, both away from the seam, as
// is its border there, which between crossing plates is the seam; mm. None where they are no part
// on the plate and one off it. dark_counts: the stripe may lie in the plate's own shadow.
EdgeEvidence evidence_of(const StripeOnPlate& stripe, double border, double begin, double width,
                         const ClaimedEnd& end, bool dark_counts);

}  // namespace arcstart::seam_finding
