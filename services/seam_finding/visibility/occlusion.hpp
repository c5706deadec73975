// Whether a seam that is lost and found again was only out of sight between.
#pragma once

#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// Between two stations that show both plates: something stands before the plates in at least one of
// the stripes, and in none of them (but for a lone one in many, a reflection) something is seen
// past a plate where it would be at the seam.
bool occluded_between(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                      const Line& line, const Stations& stations, int from, int to,
                      double tolerance);

}  // namespace arcstart::seam_finding
