// What is answered of a joint: where it starts and ends, how sure that is, its course and the
// torch.
#pragma once

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// Fills in a found seam.
void answer(SeamResult& result, const ScanCloud& scan, const Joint& joint, const Scales& scales,
            const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
