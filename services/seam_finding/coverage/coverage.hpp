// Where along a line both plates have points: the seam's two ends (paper 5, "first valid point
// along the seam").
#pragma once

#include <array>
#include <vector>

#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// The longest stretch of the line on which both plates have points, with what follows behind short
// interruptions, and behind any in which the plates are only hidden. Its ends lie half-way between
// the last stripe that shows both plates and the next one that does not. stripes is 0 where there
// is none.
Coverage find_coverage(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                       const Line& line, const Scales& scales);
Coverage find_coverage(Stations stations, const Scales& scales);

}  // namespace arcstart::seam_finding
