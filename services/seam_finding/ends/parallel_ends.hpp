// Where a seam between parallel plates starts and ends.
#pragma once

#include <array>

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// As find_crossing_ends(), each plate by the stripes' crossings of its own border and by its own
// edge. Where no stripe crosses an edge, a plate ends anywhere between the last stripe that shows
// it and the next.
std::array<SeamEnd, 2> find_parallel_ends(const ScanCloud& cloud, const Joint& joint,
                                          const Scales& scales,
                                          const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
