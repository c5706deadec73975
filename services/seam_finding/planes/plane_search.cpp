#include "services/seam_finding/planes/plane_search.hpp"

#include <algorithm>

namespace arcstart::seam_finding {

PlaneSearch plane_search(const Scales& scales, const SeamFindingSettings& settings) {
  PlaneSearch search;
  search.tolerance = scales.tolerance;
  search.connection = scales.connection;
  search.least_points = settings.plane_points_min;
  search.most_faces = settings.planes_max;
  search.locality = std::max(40.0, 6 * scales.connection);
  return search;
}

}  // namespace arcstart::seam_finding
