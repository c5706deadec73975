// Where a seam starts and ends: from the edges of both its plates.
#pragma once

#include "services/seam_finding/course.hpp"
#include "services/seam_finding/edges.hpp"

namespace arcstart {

enum class EndVisibility { kNotDetermined, kSeen, kHidden, kOutside };

struct SeamEnd {
  double along = 0;     // along the seam's line; mm
  double variance = 0;  // of it; mm2
  EndVisibility visibility = EndVisibility::kNotDetermined;
  bool by_edges = false;  // else known to half the distance of two stripes
};

struct EndSearch {
  double tolerance = 0.5;    // of a point's distance from its plate; mm
  double noise = 0.05;       // of the points across their surface, standard deviation; mm
  double shortening_px = 0;  // a stripe's last centre lies so far before the edge, square to it
  double slope = 0.001;      // of a plate's edge, standard deviation; mm along for each mm away
};

// The seam begins where both plates have begun: at the later of their edges, or, the likelier the
// nearer these lie, at what both tell of flush ones. A plate whose edge no stripe crosses begins
// somewhere between the last stripe that does not show it at the seam and the first that does.
// stripes: of the plates, in the same tolerance; along their line all places are counted.
SeamEnd find_end(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                 const Course& course, const std::array<PlateStripes, 2>& stripes, SeamSide side,
                 const EndSearch& search);

}  // namespace arcstart
