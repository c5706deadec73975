// The joint between parallel plates that the transitions on one line make.
#pragma once

#include <optional>
#include <vector>

#include "services/seam_finding/joints/transitions.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// With its coverage and score, and a flaw where something speaks against it. Nothing where too few
// transitions lie on the line, or the plates have no straight edges there.
std::optional<Joint> joint_at(const ScanCloud& cloud, const std::vector<Face>& faces,
                              const TransitionLine& candidate, const Scales& scales,
                              const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
