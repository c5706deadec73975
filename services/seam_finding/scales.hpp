// What counts as near in a cloud, from what the cloud itself shows.
#pragma once

#include "services/seam_finding/planes.hpp"
#include "services/seam_finding/scan_cloud.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart {

// All in mm.
struct Scales {
  double tolerance;   // of a point's distance from its plane
  double connection;  // between points of one piece
  double contact;     // of a plate's points to the seam's line
  double spacing;     // between stripes, or between the points of a cloud without
  double noise;       // standard deviation of a point
};

// tolerance_mm: 0: from the noise.
Scales scales_of(const ScanCloud& cloud, const Sampling& sampling, double tolerance_mm);

PlaneSearch plane_search(const Scales& scales, const SeamFindingSettings& settings);

}  // namespace arcstart
