// The plane of a plate from the points beside its seam.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// Least squares in which a point counts the less the farther off it lies, and beyond a limit not at
// all (Tukey's weights); of the strips along the line only those count that agree. `plane`: about
// where it is, through the line, and its side. noise: standard deviation of the points, mm; a
// rougher plate is allowed its own. Gives `plane` itself where the points, twenty at the least,
// determine none.
Plane robust_plane(const std::vector<Eigen::Vector3d>& points, const Line& line, const Plane& plane,
                   double noise);

// The same by the points chosen. Of more than a sample, by means over so many neighbours in a
// stripe that they are as few as one; points of no stripe have no neighbours.
Plane robust_plane(const ScanCloud& cloud, const std::vector<int>& chosen, const Line& line,
                   const Plane& plane, double noise);

}  // namespace arcstart::seam_finding
