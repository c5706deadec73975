// Connected pieces of a set of points.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace arcstart {

// Positions in `points` of the largest piece, rising. Points belong together where their cells of a
// cubic grid touch, so gaps up to one cell never part them and gaps over two (three across corners)
// always do.
std::vector<int> largest_component(const std::vector<Eigen::Vector3d>& points, double cell_mm);

}  // namespace arcstart
