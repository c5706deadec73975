// Whether a corner is the meeting of two plates, or one piece: bent or rolled, with a round edge
// outside and a round root inside, or welded already.
#pragma once

#include <optional>
#include <vector>

#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"

namespace arcstart::seam_finding {

// Radius of the arc along which the stripes run from one plate to the other, behind the planes of
// an outside corner, before those of a tee or an inside corner, mm; nothing where they do not, or
// not nearly all along the seam, or each on another arc: as over a gap, a tack or into an open
// corner. points: to be looked at; rising. tolerance: what lies within of a plane is on it; mm.
std::optional<double> corner_radius(const ScanCloud& cloud, const std::vector<int>& points,
                                    const SeamResult& seam, double tolerance);

}  // namespace arcstart::seam_finding
