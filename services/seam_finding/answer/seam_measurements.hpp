// What is measured along a seam, stripe by stripe: how straight it is, and where tack welds lie.
#pragma once

#include <array>
#include <vector>

#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"

namespace arcstart::seam_finding {

// A place for every stripe that crosses the seam between begin and end, in their order; without
// stripes for every `spacing` of it. Where the residual was not measured the position is the
// line's.
std::vector<SurveyPlace> survey_seam(const ScanCloud& cloud,
                                     const std::array<JointPlate, 2>& plates, const Line& line,
                                     double begin, double end, double spacing_mm);

// The line from begin to end where no place is farther from it than `straight_mm`; else through the
// places, averaged over three so that no single one bends it.
Polyline polyline_through(const std::vector<SurveyPlace>& places, const Eigen::Vector3d& start,
                          const Eigen::Vector3d& end, double straight_mm);

}  // namespace arcstart::seam_finding
