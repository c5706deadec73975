#include "services/seam_finding/model/plate.hpp"

#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {

Eigen::Vector3d away_from_seam(const JointPlate& plate, const JointPlate& other) {
  const Eigen::Vector3d& n = plate.plane.normal;
  const Eigen::Vector3d& toward = plate.away.isZero() ? other.plane.normal : plate.away;
  return (toward - toward.dot(n) * n).normalized();
}

std::vector<int> without_fragments(const ScanCloud& cloud, const std::vector<int>& points) {
  if (!cloud.organised()) return points;
  std::vector<int> kept;
  for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
    for (last = first + 1; last < points.size(); ++last) {
      const PointOrigin &a = cloud.origins[points[last - 1]], &b = cloud.origins[points[last]];
      if (a.stripe != b.stripe || a.segment != b.segment ||
          points[last] - points[last - 1] > kModel.sure_points)
        break;
    }
    const bool ends =
        cloud.origins[points[first]].segment_end || cloud.origins[points[last - 1]].segment_end;
    if (last - first + ends >= kModel.sure_points)
      kept.insert(kept.end(), points.begin() + static_cast<std::ptrdiff_t>(first),
                  points.begin() + static_cast<std::ptrdiff_t>(last));
  }
  return kept;
}

}  // namespace arcstart::seam_finding
