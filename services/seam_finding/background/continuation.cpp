#include "services/seam_finding/background/continuation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "services/seam_finding/background/constants.hpp"
#include "services/seam_finding/fit/plane_fit.hpp"

namespace arcstart::seam_finding {
namespace {

bool lies_off_background(const Face& face, const std::vector<int>& off) {
  const auto lies_off = std::count_if(face.points.begin(), face.points.end(), [&](int i) {
    return std::binary_search(off.begin(), off.end(), i);
  });
  return 2 * lies_off > static_cast<std::ptrdiff_t>(face.points.size());
}

bool continues_background(const ScanCloud& scan, const std::vector<int>& background,
                          const Face& face, const Scales& scales) {
  Eigen::Vector3d low = scan.points[face.points.front()], high = low;
  for (const int i : face.points)
    low = low.cwiseMin(scan.points[i]), high = high.cwiseMax(scan.points[i]);
  const double around = 4 * scales.connection;
  PlaneSums in_plane(low);
  const std::size_t every = 1 + background.size() / kCloud.small_sample;
  for (std::size_t i = 0; i < background.size(); i += every) {
    const Eigen::Vector3d& p = scan.points[background[i]];
    if (std::abs(face.plane.signed_distance(p)) <= scales.tolerance &&
        (p - low).minCoeff() > -around && (high - p).minCoeff() > -around)
      in_plane.add(p);
  }
  // Where the plane only cuts through the background they lie on a narrow strip.
  return in_plane.weight() * static_cast<double>(every) >=
             std::max(10.0, kBackground.continues * static_cast<double>(face.points.size())) &&
         in_plane.fit().spread[0] > 3 * scales.tolerance;
}

}  // namespace

std::vector<Face> without_background(const ScanCloud& cloud, const Segmentation& segmentation,
                                     std::vector<Face> faces, const Scales& scales) {
  std::erase_if(faces, [&](const Face& face) {
    return !lies_off_background(face, segmentation.off) &&
           continues_background(cloud, segmentation.background, face, scales);
  });
  return faces;
}

}  // namespace arcstart::seam_finding
