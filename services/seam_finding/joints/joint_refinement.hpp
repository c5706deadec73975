// A joint measured again by what lies beside its seam.
#pragma once

#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

struct Refit {
  int passes = 2;
  double distance = 60;  // from the seam up to which points count; mm
  int neighbours = 10;   // of statistical outlier removal, 0 for none
  double deviations = 3;
  double noise = 0.05;     // of the points across their surface, standard deviation; mm
  double tolerance = 0.5;  // of a point's distance from its plate; mm
};

// Robust least-squares planes of both plates from the points beside the seam, without those so near
// the other plate that the stripe bends there, segment ends and outliers; then the line and the
// course anew.
void refit_joint(const ScanCloud& cloud, Joint& joint, const Refit& refit,
                 const CourseSearch& search);
}  // namespace arcstart::seam_finding
