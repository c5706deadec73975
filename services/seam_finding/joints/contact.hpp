// Whether what was seen of a plate is at a line.
#pragma once

#include <algorithm>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// distance: mm
inline bool touches(const ScanCloud& cloud, const std::vector<int>& points, const Line& line,
                    double distance) {
  return std::any_of(points.begin(), points.end(),
                     [&](int i) { return line.distance(cloud.points[i]) <= distance; });
}

// mm. A face with points far apart is at the seam though none comes very near it.
inline double contact_of(const Face& face, const Scales& scales) {
  return std::max(scales.contact, 2 * face.spacing);
}

}  // namespace arcstart::seam_finding
