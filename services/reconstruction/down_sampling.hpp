// The paper's down-sampling: one centre of every M along the stripe.
#pragma once

#include <vector>

#include "services/reconstruction/stripe.hpp"

namespace arcstart {

// Of each segment the centres 0, M, 2M ... and the last, in their order; its first and last are
// marked as its ends. A plate's edge is seen at a segment's end: kept, it costs the seam no
// accuracy whatever M is.
std::vector<ReceivedCentre> down_sample(const std::vector<ReceivedCentre>& centres, int keep_every);

}  // namespace arcstart
