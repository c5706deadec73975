// What is measured along a seam, stripe by stripe: how straight it is, and where tack welds lie.
#pragma once

#include <vector>

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"

namespace arcstart::seam_finding {

// A place for every stripe that crosses the seam between begin and end, in their order; without
// stripes for every `spacing` of it. Where the residual was not measured the position is the
// line's. Of a tee, an inside corner and a lap with the root gap, of a butt joint or groove with
// its width at the top.
std::vector<SeamMeasurement> measure_seam(const ScanCloud& cloud, const Joint& joint, double begin,
                                          double end, double spacing_mm);

// The line from begin to end where no place is farther from it than `straight_mm`; else through the
// places, averaged over three so that no single one bends it.
Polyline polyline_through(const std::vector<SeamMeasurement>& places, const Eigen::Vector3d& start,
                          const Eigen::Vector3d& end, double straight_mm);

}  // namespace arcstart::seam_finding
