// What the stripes of a scan show of one plate of a joint.
#pragma once

#include <optional>
#include <vector>

#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/visibility/plate_bend.hpp"

namespace arcstart::seam_finding {

struct PlateStripes {
  const JointPlate &plate, &other;  // of the joint
  Line line;                        // the seam's
  Eigen::Vector3d away;             // in the plate, away from the seam; unit
  // A stripe's points on the plate, on its open side, in the stripe's order, for every stripe of
  // the scan; none in a cloud without stripes. What lies in the plate's plane beyond a place where
  // something is seen behind it is another thing of the same height, and left out. So is what runs
  // through the plane at an angle: a reflection, or the cut at the plate's end.
  std::vector<std::vector<int>> runs = {};
  PlateBend bend = {};
  // How far the plate reaches away from the seam: half of the stripes that show it reach so far;
  // mm, 0 where none does.
  double reach = 0;
  // mm away from the seam; so wide the other plate's cut may lie in this one's face.
  double cut = 0;
};

// Over the plate as it is bent; mm.
inline double height_over(const PlateStripes& stripes, const Eigen::Vector3d& point) {
  return stripes.plate.plane.signed_distance(point) - stripes.bend.at(stripes.line.along(point));
}

// The plates must outlive what is returned.
PlateStripes plate_stripes(const ScanCloud& cloud, const JointPlate& plate, const JointPlate& other,
                           const Line& line, const Scales& scales);

// Where the line of sight to a point behind the plate meets the plate; nothing for a point that is
// not behind it, or that is seen along the plate.
std::optional<Eigen::Vector3d> seen_through(const ScanCloud& cloud, const PlateStripes& stripes,
                                            int point, double tolerance);
// The same of a plane.
std::optional<Eigen::Vector3d> seen_through(const ScanCloud& cloud, const Plane& plane, int point,
                                            double tolerance);

}  // namespace arcstart::seam_finding
