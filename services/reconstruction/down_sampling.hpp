// The paper's down-sampling: one centre of every M along the stripe.
#pragma once

#include <vector>

#include "services/reconstruction/stripe.hpp"

namespace arcstart::reconstruction {

// Of each segment the centres 0, M, 2M ... and the last, in their order. Its first and last alone,
// and always, say why it ends there. A plate's edge is seen at a segment's end: kept, it costs the
// seam no accuracy whatever M is. bend_px: where the stripe departs farther than this from the
// straight line between two that are kept, the farthest is kept as well, and so on between these; 0
// for none.
std::vector<ReceivedCentre> down_sample(const std::vector<ReceivedCentre>& centres, int keep_every,
                                        double bend_px = 0);

}  // namespace arcstart::reconstruction
