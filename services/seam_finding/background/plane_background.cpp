#include "services/seam_finding/background/plane_background.hpp"

#include <vector>

#include "services/seam_finding/background/constants.hpp"
#include "services/seam_finding/cloud/scales.hpp"
#include "services/seam_finding/planes/plane_search.hpp"
#include "services/seam_finding/planes/planes.hpp"

namespace arcstart::seam_finding {

std::optional<Plane> dominant_plane(const ScanCloud& cloud, std::uint64_t seed) {
  const Scales scales = scales_of(cloud, measure_sampling(cloud), 0);
  PlaneSearch search = plane_search(scales, {});
  search.most_faces = 1;
  std::vector<int> all(cloud.points.size());
  for (int i = 0; i < cloud.size(); ++i) all[i] = i;
  const auto faces = find_faces(cloud, all, search, seed);
  if (faces.empty()) return std::nullopt;
  const Plane plane = faces.front().plane;
  int above = 0, below = 0;
  for (const auto& point : cloud.points) {
    above += plane.signed_distance(point) > kBackground.plane_heights * scales.tolerance;
    below += plane.signed_distance(point) < -kBackground.plane_heights * scales.tolerance;
  }
  return above >= below ? plane : plane.flipped();
}

PlaneBackground::PlaneBackground(const ScanCloud& cloud, const Plane& plane)
    : plane_(plane),
      height_(kBackground.plane_heights * scales_of(cloud, measure_sampling(cloud), 0).tolerance) {}

bool PlaneBackground::contains(const Eigen::Vector3d& point) const {
  return plane_.signed_distance(point) <= height_;
}

}  // namespace arcstart::seam_finding
