// The background of a cloud that comes without one: its largest plane.
#pragma once

#include <cstdint>
#include <optional>

#include "common/geometry.hpp"
#include "services/seam_finding/background/background.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// The largest plane of a cloud, turned to the side on which more points lie. For clouds that come
// without background. Nothing where there is none.
std::optional<Plane> dominant_plane(const ScanCloud& cloud, std::uint64_t seed);

// Takes for background what lies on a plane, up to five times the cloud's own tolerance above it,
// and all below.
class PlaneBackground : public Background {
 public:
  PlaneBackground(const ScanCloud& cloud, const Plane& plane);
  bool contains(const Eigen::Vector3d& point) const override;

 private:
  Plane plane_;
  double height_;
};

}  // namespace arcstart::seam_finding
