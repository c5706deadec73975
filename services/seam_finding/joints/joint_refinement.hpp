// A crossing joint measured again by what lies beside its seam.
#pragma once

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

struct RefinementPasses {
  int count = 2;
  bool drop_outliers = true;  // by the settings' statistics of neighbours
};

// Robust least-squares planes of both plates from the points beside the seam, without those so near
// the other plate that the stripe bends there, segment ends and outliers; from them the line and
// the coverage.
Joint refined(const ScanCloud& cloud, Joint joint, const RefinementPasses& passes,
              const Scales& scales, const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
