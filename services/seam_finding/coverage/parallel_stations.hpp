// Where stripes cross the borders of the two plates of a lap, butt or V-groove.
#pragma once

#include <array>

#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// As stations_along(), for each plate by its own border: a stripe at a slant crosses the two at
// unlike places. Places are along the joint's line; each holds for its plate alone.
std::array<Stations, 2> stations_by_edge(const ScanCloud& cloud, const Joint& joint,
                                         const Scales& scales);

// Both plates together; a station lies half-way between its two crossings.
Stations stations_of_both(const std::array<Stations, 2>& by_border);

}  // namespace arcstart::seam_finding
