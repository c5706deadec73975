// Which of the chains are reflections of the stripe: light that has gone from one surface to
// another before it was seen.
#pragma once

#include <vector>

#include "services/extraction/lines/junctions.hpp"
#include "services/extraction/ridge/ridge.hpp"

namespace arcstart::extraction {

// A laser sheet is seen at most once a column, but for what hides and what
// reflects. Of two strands in the same columns one is marked, if it hangs, that is, leads to
// nothing:
// - from a corner the stripe goes on along the next surface, and its reflection as well. The stripe
// is the one that leads on; where neither does, the stronger by far, or the stronger of which the
// other fades beside it;
// - what runs beside a stronger one for most of its length is its reflection, also where that one
// has a gap.
void mark_reflections(const std::vector<RidgePoint>& points, const Sight& sight,
                      FrameVector<Strand>& strands);

}  // namespace arcstart::extraction
