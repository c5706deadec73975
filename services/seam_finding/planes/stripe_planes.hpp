// Planes that a scan's stripes suggest: a plate cut by the laser's plane is a straight piece of the
// stripe, and the next stripe goes on with it.
#pragma once

#include <vector>

#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/planes/plane_search.hpp"

namespace arcstart::seam_finding {

// Of the points named by `indices`, rising: each stripe is parted into straight pieces, and pieces
// of stripes that follow each other and lie in one plane are joined; three of them or more suggest
// it. The one with the most points first, search.hypotheses at the most. Sides are left open.
// Nothing in a cloud without stripes.
std::vector<Plane> planes_of_stripes(const ScanCloud& cloud, const std::vector<int>& indices,
                                     const PlaneSearch& search);

}  // namespace arcstart::seam_finding
