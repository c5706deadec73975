// Where a seam between crossing plates starts and ends: from the edges of both its plates.
#pragma once

#include <array>

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// The seam begins where both plates have begun: at the later of their edges, or, the likelier the
// nearer these lie, at what both tell of flush ones. A plate whose edge no stripe crosses begins
// somewhere between the last stripe that does not show it at the seam and the first that does.
// Start and end, along the joint's line.
std::array<SeamEnd, 2> find_crossing_ends(const ScanCloud& cloud, const Joint& joint,
                                          const Scales& scales,
                                          const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
