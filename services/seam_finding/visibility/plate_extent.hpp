// How far a plate reaches along a seam for certain, and where it is no more for certain, from what
// is seen on it and past it.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/visibility/plate_stripes.hpp"

namespace arcstart::seam_finding {

// Where each stripe crosses the line, by its index; nothing where it does not. mm
struct StripeCrossings {
  std::vector<std::optional<double>> along;
  double slant = 0;  // mm along the line for each mm away from it in the plate
};

// Stripes cross a plate at a slant: one that lies on it shows how far it reaches at the stripe's
// farthest place, not only where it crosses the seam. And a point that is seen behind the plate's
// plane is seen past the plate: its line of sight meets the plane where no plate is. Both hold at
// the seam along the plate's edge, whose `slope` along the seam for each mm away is known to a
// hundredth. Where the stripes' crossings of the line are given,
// a stripe that falls behind the plate tells that none is where it crosses the plate's plane. What
// lies in that plane beyond a place that is seen past is another thing. Looks at the stripes about
// `near`, a place on the plate, along the line; mm. Nothing is known in a cloud without stripes.
PlateExtent plate_extent(const ScanCloud& cloud, const PlateStripes& stripes, SeamSide side,
                         double near, double slope, const Scales& scales,
                         const StripeCrossings& crossings = {});
// The first of the two alone, at much less cost; from what lies no farther than `reach` from the
// seam, mm.
double seen_on_plate(const ScanCloud& cloud, const PlateStripes& stripes, SeamSide side,
                     double near, double slope, const Scales& scales,
                     const StripeCrossings& crossings = {},
                     double reach = std::numeric_limits<double>::infinity());

}  // namespace arcstart::seam_finding
