// The places along a line at which a scan looked at both plates.
#pragma once

#include <array>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// A station for every stripe of the scan, also those that cross the line where no plate is, in the
// order of their places. A stripe's crossing is extrapolated from the points beside the line, with
// the slant at which stripes cross the plates; where it shows no plate, it is carried there by the
// tool's way from the nearest stripe that does. A cloud without stripes has one for every `spacing`
// of the line.
Stations stations_along(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                        const Line& line, const Scales& scales);

}  // namespace arcstart::seam_finding
