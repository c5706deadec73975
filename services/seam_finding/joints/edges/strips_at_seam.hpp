// What stripes show of a plate between the seam and a hole or a notch beside it.
#pragma once

#include <vector>

#include "services/seam_finding/model/plate.hpp"

namespace arcstart::seam_finding {

// Points that lie on the plate's plane, before the other plate, on which a stripe runs without a
// break as it comes off the other plate: too few for a face of their own where points were thinned
// out, but no chance puts them there. None in a cloud without stripes. Rising; those of the plate's
// own among them. tolerance: what lies within of a plane is on it; mm.
std::vector<int> strips_at_seam(const ScanCloud& cloud, const JointPlate& plate,
                                const JointPlate& other, double tolerance);

}  // namespace arcstart::seam_finding
