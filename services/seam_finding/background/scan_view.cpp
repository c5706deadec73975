#include "services/seam_finding/background/scan_view.hpp"

#include <utility>

namespace arcstart::seam_finding {

ScanView::ScanView(const ScanCloud& cloud, const Segmentation& segmentation,
                   const DownsampledCloud& fewer)
    : cloud_(cloud),
      segmentation_(segmentation),
      fewer_(fewer),
      has_fewer_(fewer.is_less_than(cloud)),
      fewer_segmentation_(has_fewer_ ? segmentation_of(fewer, segmentation) : Segmentation()) {}

const ScanCloud& ScanView::points_for(Stage stage) const {
  return stage == Stage::kSearch && has_fewer_ ? fewer_.cloud : cloud_;
}

std::vector<int> ScanView::all_on_plane(std::vector<int> points, const Plane& plane,
                                        double tolerance_mm) const {
  return has_fewer_ ? upsampled(cloud_, fewer_, points, plane, tolerance_mm) : std::move(points);
}

}  // namespace arcstart::seam_finding
