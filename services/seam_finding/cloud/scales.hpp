// What counts as near in a cloud, from what the cloud itself shows.
#pragma once

#include "services/seam_finding/cloud/sampling.hpp"
#include "services/seam_finding/model/scales.hpp"

namespace arcstart::seam_finding {

// tolerance_mm: 0: from the noise.
Scales scales_of(const ScanCloud& cloud, const Sampling& sampling, double tolerance_mm);

}  // namespace arcstart::seam_finding
