// Where a plate ends toward the other, by the points of one transition alone.
#pragma once

#include "services/seam_finding/fit/line_fit.hpp"
#include "services/seam_finding/joints/transitions.hpp"

namespace arcstart::seam_finding {

// Of a transition, the plate's own point next to what lies between; index into the cloud.
int last_on_plate(const Transition& transition, int plate);

// What follows on a plate's last point, outward; -1 where it lies in another segment.
int follower(const ScanCloud& cloud, const Transition& transition, int plate);

// Where the plate ends by its last point alone: at a segment's end, or before what follows on it,
// `next`, -1 for nothing. pitch_mm: between points of a stripe.
LinePlace end_place(const ScanCloud& cloud, const Transition& transition, const PlateFrame& frame,
                    int plate, int next, double pitch_mm);

}  // namespace arcstart::seam_finding
