// What is seen past a plate where it has not begun yet: through a gap, or under a round edge.
#pragma once

#include "services/seam_finding/model/plate.hpp"

namespace arcstart::seam_finding {

// How far from the seam's line half of the stripes first show the plate; mm, 0 in a cloud without
// stripes.
double begins_at(const ScanCloud& cloud, const JointPlate& plate, const Line& line);

// Whether a point behind a plate's plane is seen through that plane nearer to the line than the
// plate begins. Never in a cloud without stripes.
bool seen_under(const ScanCloud& cloud, int point, const Plane& plate, const Line& line,
                double begin);

}  // namespace arcstart::seam_finding
