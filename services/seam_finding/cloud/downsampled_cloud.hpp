// A scan with fewer points: faces are found, and their pairs ranked, as well by some of the points
// of a stripe as by all.
#pragma once

#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

struct DownsampledCloud {
  ScanCloud cloud;
  std::vector<int> places;  // of its points in the whole scan, rising

  // By so much that it is worth while.
  bool is_less_than(const ScanCloud& scan) const {
    return !places.empty() && 2 * places.size() < scan.points.size();
  }
};

// Of each segment its two ends, what the profile marks as ends, and between them points no nearer
// to each other than 1.5 mm. Goes on behind the last stripe that is downsampled already: a scan can
// be downsampled stripe by stripe. Nothing of a cloud without stripes.
void downsample(const ScanCloud& scan, DownsampledCloud& downsampled);

// Of a face found among the downsampled points the whole scan's: those points, and between and
// beside them what lies on the plane. Rising.
std::vector<int> upsampled(const ScanCloud& scan, const DownsampledCloud& downsampled,
                           const std::vector<int>& points, const Plane& plane, double tolerance_mm);

}  // namespace arcstart::seam_finding
