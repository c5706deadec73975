#include "services/seam_finding/joints/edges/strips_at_seam.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart::seam_finding {

std::vector<int> strips_at_seam(const ScanCloud& cloud, const JointPlate& plate,
                                const JointPlate& other, double tolerance) {
  std::vector<int> strips;
  if (!cloud.organised()) return strips;
  const auto goes_on = [&](int i, int from) {
    return i >= 0 && i < cloud.size() && cloud.origins[i].stripe == cloud.origins[from].stripe &&
           cloud.origins[i].segment == cloud.origins[from].segment &&
           std::abs(plate.plane.signed_distance(cloud.points[i])) <= tolerance &&
           other.plane.signed_distance(cloud.points[i]) > tolerance;
  };
  for (const int from : other.points)
    for (const int step : {-1, 1})
      for (int i = from + step; goes_on(i, from); i += step) strips.push_back(i);
  std::sort(strips.begin(), strips.end());
  strips.erase(std::unique(strips.begin(), strips.end()), strips.end());
  return strips;
}

}  // namespace arcstart::seam_finding
