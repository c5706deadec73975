// The places where stripes leave a plate over the edge at which it begins or ends along a seam.
#pragma once

#include <optional>
#include <vector>

#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"
#include "services/seam_finding/visibility/plate_stripes.hpp"

namespace arcstart::seam_finding {

struct EdgeCrossing {
  double along = 0, away = 0;  // of the seam, from it; mm
  // The stripe's way out of the plate, along the seam and away from it; unit.
  double way_along = 0, way_away = 0;
  // Standard deviations for want of resolution alone: along the seam, and along the stripe; mm.
  double deviation = 0, spread = 0;
  double pixel = 0;    // what a pixel square to the edge is along the seam; mm
  bool ended = false;  // by the end of a segment: its light ends before the edge
  bool occluded = false;
  bool falls = false;  // what the stripe shows next lies behind the plate: it has ended
};

// Of a plate's points in one stripe, where they end at the back or at the front: a stripe leaves a
// plate over an edge that runs away from the seam more steeply than itself where it comes nearer to
// the seam, over any other where it goes farther. Nothing where it goes on to the other plate.
std::optional<EdgeCrossing> edge_crossing(const ScanCloud& cloud, const std::vector<int>& run,
                                          const PlateStripes& stripes, bool at_back,
                                          const Scales& scales);

}  // namespace arcstart::seam_finding
