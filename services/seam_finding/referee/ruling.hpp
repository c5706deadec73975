// What becomes of an answer that was examined.
#pragma once

#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/referee/examination.hpp"

namespace arcstart::seam_finding {

// A seam that the stripes contradict as a whole is refused. An end that they bound less closely
// than it claims gets the deviation that they leave; one that they contradict, or know less than
// two spacings of stripes, is not determined, with their bounds as its second place.
void rule(const Examination& examination, SeamResult& seam);

}  // namespace arcstart::seam_finding
