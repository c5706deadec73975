// How a plate is bent along the seam: plates are planes but for a millimetre.
#pragma once

#include <Eigen/Core>

#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// A parabola along the seam's line, over the plate's plane; mm.
struct PlateBend {
  double origin = 0;  // along
  double height = 0, slope = 0, curvature = 0;

  double at(double along) const {
    const double x = along - origin;
    return height + slope * x + curvature * x * x;
  }
  double slope_at(double along) const { return slope + 2 * curvature * (along - origin); }
  // All of it so many times.
  PlateBend times(double factor) const {
    return {origin, factor * height, factor * slope, factor * curvature};
  }
  bool bent() const { return height != 0 || slope != 0 || curvature != 0; }
};

// Of what lies beside the seam, on the plate's side: by the plate's own points first, then by those
// that lie where these go on. None where it tells no bend beyond the noise, or more than plates
// have.
PlateBend plate_bend(const ScanCloud& cloud, const JointPlate& plate, const Line& line,
                     const Eigen::Vector3d& away, const Scales& scales);

}  // namespace arcstart::seam_finding
