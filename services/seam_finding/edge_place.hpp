// The places where stripes leave a plate over the edge at which it begins or ends along a seam.
#pragma once

#include <optional>
#include <vector>

#include "services/seam_finding/edges.hpp"

namespace arcstart {

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

}  // namespace arcstart
