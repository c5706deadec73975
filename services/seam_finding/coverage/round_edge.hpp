// A plate whose edge at the seam is round: a hollow section's or an angle's, standing on another.
#pragma once

#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// How far from the seam's line a face begins because its edge there is round; mm, 0 where most
// stripes do not show that. There a stripe leaves the face tangentially, in the same segment,
// behind its plane and on an arc that touches both planes, until the metal hides it. A face that is
// narrower than the arc's radius is a strip of a bar. line: where the planes cross. points: of the
// face, indices, rising.
double round_edge(const ScanCloud& cloud, const std::vector<int>& points, const Plane& plane,
                  const Plane& other, const Line& line, const Scales& scales);

}  // namespace arcstart::seam_finding
