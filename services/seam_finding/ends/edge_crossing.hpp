// The places where stripes leave a plate over the edge at which it begins or ends along a seam.
#pragma once

#include <optional>
#include <vector>

#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/visibility/plate_stripes.hpp"

namespace arcstart::seam_finding {

struct EdgeSearch {
  double from = 0, to = 0;   // along the line, where the edge may cross it; mm
  double beyond = 0;         // so much farther if several stripes tell the same
  double tolerance = 0.5;    // of a point's distance from its plate; mm
  double noise = 0.05;       // of the points across their surface, standard deviation; mm
  double shortening_px = 0;  // a stripe's last centre lies so far before the edge, square to it
  double slope = 0.001;      // of a plate's edge, standard deviation; mm along for each mm away
};

struct EdgePlace {
  double along = 0, away = 0;  // of the seam, from it; mm
  double deviation = 0;        // of along, for want of resolution alone; mm
  double pixel = 0;    // what a pixel square to the edge is along the seam; mm, at a segment's end
  bool sharp = false;  // a segment ends there, or turns over the edge
  bool occluded = false;
};

// Of a plate's points in one stripe. Nothing where it goes on to the other plate, or runs along the
// edge.
std::optional<EdgePlace> edge_place(const ScanCloud& cloud, const std::vector<int>& run,
                                    const PlateStripes& stripes, SeamSide side,
                                    const EdgeSearch& search);

}  // namespace arcstart::seam_finding
