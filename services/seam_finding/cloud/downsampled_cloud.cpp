#include "services/seam_finding/cloud/downsampled_cloud.hpp"

#include <algorithm>
#include <cmath>

#include "services/seam_finding/cloud/constants.hpp"

namespace arcstart::seam_finding {
namespace {

bool same_segment(const ScanCloud& scan, int a, int b) {
  return scan.origins[a].segment == scan.origins[b].segment &&
         scan.origins[a].stripe == scan.origins[b].stripe;
}

}  // namespace

void downsample(const ScanCloud& scan, DownsampledCloud& downsampled) {
  ScanCloud& few = downsampled.cloud;
  const Eigen::Vector3d* points = scan.points.data();
  const PointOrigin* origins = scan.origins.data();
  for (std::size_t k = few.stripes.size(); k < scan.stripes.size(); ++k) {
    const ScanStripe& stripe = scan.stripes[k];
    const int end = stripe.first + stripe.count;
    bool first = true, last = false;        // of a segment
    const Eigen::Vector3d* kept = nullptr;  // the last one of it
    for (int i = stripe.first; i < end; ++i, first = last) {
      last = i + 1 == end || origins[i].segment != origins[i + 1].segment;
      if (!first && !last && !origins[i].segment_end &&
          (points[i] - *kept).squaredNorm() < kCloud.thinned_step * kCloud.thinned_step)
        continue;
      kept = &points[i];
      few.points.push_back(*kept);
      few.origins.push_back(origins[i]);
      downsampled.places.push_back(i);
    }
    end_stripe(few, stripe.seen, stripe.camera_centre, stripe.tool_position, stripe.tool_turn);
  }
}

std::vector<int> upsampled(const ScanCloud& scan, const DownsampledCloud& downsampled,
                           const std::vector<int>& points, const Plane& plane,
                           double tolerance_mm) {
  std::vector<int> whole;
  whole.reserve(scan.points.size() / 2);
  int taken = -1;  // the last one that was looked at
  for (const int point : points) {
    const int own = downsampled.places[point];
    const auto neighbour = [&](int step) {
      const int next = point + step;
      return next >= 0 && next < downsampled.cloud.size() &&
                     same_segment(downsampled.cloud, point, next)
                 ? downsampled.places[next]
                 : own;
    };
    const int from = neighbour(-1), to = neighbour(+1);
    for (int i = std::max(taken + 1, std::min(from + 1, own)); i < std::max(to, own + 1); ++i) {
      taken = i;
      if (i == own || std::abs(plane.signed_distance(scan.points[i])) <= tolerance_mm)
        whole.push_back(i);
    }
  }
  return whole;
}

}  // namespace arcstart::seam_finding
