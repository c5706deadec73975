// What is measured along a seam between parallel plates, stripe by stripe.
#pragma once

#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"

namespace arcstart::seam_finding {

// As survey_seam(): a place for every station between begin and end; the gap where it was seen, and
// tack welds. What the stations alone tell of the seam's course is coarser than its line, so that
// no residual is given.
std::vector<SurveyPlace> survey_flat(const ScanCloud& cloud, const Joint& joint,
                                     const Stations& stations, double begin, double end,
                                     double spacing_mm);

}  // namespace arcstart::seam_finding
