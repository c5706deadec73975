#include "services/seam_finding/joints/edges/seen_under.hpp"

#include <algorithm>
#include <vector>

#include "common/order_statistics.hpp"

namespace arcstart::seam_finding {

double begins_at(const ScanCloud& cloud, const JointPlate& plate, const Line& line) {
  if (!cloud.organised()) return 0;
  std::vector<double> nearest;
  int stripe = -1;
  for (const int i : plate.points) {
    const double r = line.distance(cloud.points[i]);
    if (cloud.origins[i].stripe != stripe)
      stripe = cloud.origins[i].stripe, nearest.push_back(r);
    else
      nearest.back() = std::min(nearest.back(), r);
  }
  return median(nearest);
}

bool seen_under(const ScanCloud& cloud, int point, const Plane& plate, const Line& line,
                double begin) {
  if (!cloud.organised()) return false;
  const Eigen::Vector3d& eye = cloud.seen_from(point);
  const double before = plate.signed_distance(eye),
               behind = -plate.signed_distance(cloud.points[point]);
  if (before <= 0 || behind <= 0) return false;
  const Eigen::Vector3d through = eye + (cloud.points[point] - eye) * (before / (before + behind));
  return line.distance(through) <= begin;
}

}  // namespace arcstart::seam_finding
