// What the stripes of a scan show of one plate of a joint.
#pragma once

#include <optional>
#include <vector>

#include "services/seam_finding/stations.hpp"

namespace arcstart {

// A stripe's points on the plate, on its open side, in the stripe's order, for every stripe of the
// scan. What lies in the plate's plane beyond a place where something is seen behind it is another
// thing of the same height, and left out. tolerance: of a point's distance from the plate; mm.
using PlateStripes = std::vector<std::vector<int>>;
PlateStripes plate_stripes(const ScanCloud& cloud, const JointPlate& plate, const Line& line,
                           const Eigen::Vector3d& away, double tolerance);

// How far the plate reaches away from the seam: half of the stripes that show it reach so far; mm,
// 0 where none does.
double reach_of(const ScanCloud& cloud, const PlateStripes& stripes, const Line& line,
                const Eigen::Vector3d& away);

// Where the line of sight to a point behind the plate meets the plate's plane; nothing for a point
// that is not behind it, or that is seen along the plane.
std::optional<Eigen::Vector3d> seen_through(const ScanCloud& cloud, const Plane& plane, int point,
                                            double tolerance);

}  // namespace arcstart
