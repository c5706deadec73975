// A scan's points, and which of them each stage of the search works with.
#pragma once

#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/background/segmentation.hpp"
#include "services/seam_finding/cloud/downsampled_cloud.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

enum class Stage {
  kSearch,  // faces, and which pair of them is the joint: some of a stripe's points tell as well
  kMeasure  // where the seam runs, starts and ends: all points
};

class ScanView {
 public:
  // All three must outlive it. Where `fewer` is not much less than the cloud, both stages work with
  // the cloud.
  ScanView(const ScanCloud& cloud, const Segmentation& segmentation, const DownsampledCloud& fewer);

  const ScanCloud& points_for(Stage stage) const;
  // Of those points.
  const Segmentation& segmentation(Stage stage) const {
    return stage == Stage::kSearch && has_fewer_ ? fewer_segmentation_ : segmentation_;
  }
  const std::vector<int>& workpiece(Stage stage) const { return segmentation(stage).workpiece; }

  bool has_fewer() const { return has_fewer_; }
  // The cloud's points on a plate or face, of the points for the search that lie on it: those, and
  // what lies on the plane between and beside them.
  std::vector<int> all_on_plane(std::vector<int> points, const Plane& plane,
                                double tolerance_mm) const;

 private:
  const ScanCloud& cloud_;
  const Segmentation& segmentation_;
  const DownsampledCloud& fewer_;
  bool has_fewer_;
  Segmentation fewer_segmentation_;
};

}  // namespace arcstart::seam_finding
