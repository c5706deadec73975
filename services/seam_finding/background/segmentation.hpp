// A scan's points parted into background and workpiece.
#pragma once

#include <vector>

#include "services/seam_finding/background/background.hpp"
#include "services/seam_finding/cloud/downsampled_cloud.hpp"

namespace arcstart::seam_finding {

// A cloud's points by whether they are background, indices, rising.
struct Segmentation {
  std::vector<int> background, workpiece;
  std::vector<int> off;  // of the workpiece, what lies off a background that is known there
  int size() const { return static_cast<int>(background.size() + workpiece.size()); }
};
// Goes on behind the last point that is segmented already: a scan can be segmented stripe by
// stripe.
void segment(const ScanCloud& scan, const Background& background, Segmentation& segmentation);

// The same of the downsampled points, by their own places.
Segmentation segmentation_of(const DownsampledCloud& downsampled, const Segmentation& whole);

}  // namespace arcstart::seam_finding
