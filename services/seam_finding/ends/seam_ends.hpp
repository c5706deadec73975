// Where a seam starts and ends: where the first of its two plates does.
#pragma once

#include <array>

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// Begin and end, along the joint's line. Of crossing plates each is looked at from that line, of
// parallel ones each from its own edge at the seam.
std::array<SeamEnd, 2> find_seam_ends(const ScanCloud& cloud, const Joint& joint,
                                      const Scales& scales, const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
