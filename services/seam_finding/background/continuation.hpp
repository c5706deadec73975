// Faces that only continue the background.
#pragma once

#include <vector>

#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// The faces but for those in whose plane the background goes on: background that its own scan did
// not reach, or let through. background: indices into the cloud.
std::vector<Face> without_background(const ScanCloud& cloud, const std::vector<int>& background,
                                     std::vector<Face> faces, const Scales& scales);

}  // namespace arcstart::seam_finding
