// Which joint two plates side by side make: by their edges, and by the step between their tops.
#pragma once

#include "services/seam_finding/joints/transitions.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// How far a point of a plate lies from its plane; mm.
double near_plate(const Scales& scales);

// How far a plate reaches away from a border, but for a tenth of its points; mm.
double reach_of(const ScanCloud& cloud, const JointPlate& plate, const Line& border);

// Of the joint's plates: its type, its line, the plates' edges and the gap's deviation, with a flaw
// where such a joint is not wanted. False where the plates have no edges that are straight.
bool set_type(const ScanCloud& cloud, const TransitionLine& candidate, const Scales& scales,
              const SeamFindingSettings& settings, Joint& joint);

}  // namespace arcstart::seam_finding
