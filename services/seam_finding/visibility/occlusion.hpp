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

// Whether something stands before both plates in one of the stripes that cross the line within
// `around` mm of a place on it; it may hide the seam there.
bool stands_before(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                   const Line& line, const Stations& stations, double along, double around);

// Whether something stands before both plates that is so high over the one of them, and so near a
// place on it, that it may hide what is beside the place, or keep the light from it.
bool may_hide(const ScanCloud& cloud, const JointPlate& plate, const JointPlate& other,
              const Eigen::Vector3d& place);

}  // namespace arcstart::seam_finding
