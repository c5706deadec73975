// Statistical outlier removal (paper 5, step 3).
#pragma once

#include <vector>

#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// Those of the points whose mean distance to their `neighbours` nearest among them is not above the
// mean of all such distances by more than `deviations` standard deviations. Points in sparse places
// (plates' ends) go first: never before the ends of a seam are found. `spacing`: of the points,
// about; a point with no neighbour within about 3 of it, of many
// points 2, goes. Of more than four thousand points
// one in so many tells what is usual that five hundred do.
std::vector<int> without_outliers(const ScanCloud& cloud, const std::vector<int>& points,
                                  int neighbours, double deviations, double spacing);

}  // namespace arcstart::seam_finding
