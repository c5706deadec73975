// Faces that only continue the background.
#pragma once

#include <vector>

#include "services/seam_finding/background/segmentation.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// The faces but for those in whose plane the background goes on: background that its own scan did
// not reach, or let through. A face that lies for the most part off a background that is known
// there is none, though the background comes into its plane: a thin sheet, or one that lies askew.
std::vector<Face> without_background(const ScanCloud& cloud, const Segmentation& segmentation,
                                     std::vector<Face> faces, const Scales& scales);

}  // namespace arcstart::seam_finding
