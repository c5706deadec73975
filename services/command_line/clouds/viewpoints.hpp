// Where a sensor may have stood, for a cloud whose file does not say.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry.hpp"

namespace arcstart::command_line {

// 1 m above the plane, on its normal's side, over the points' middle. points: not empty; mm.
Eigen::Vector3d viewpoint_above(const std::vector<Eigen::Vector3d>& points, const Plane& plane);

// Where else: aslant from all around, for whoever looks along an upright plate cannot tell its
// sides; from the plane's other side too, where both are asked for.
std::vector<Eigen::Vector3d> other_viewpoints(const std::vector<Eigen::Vector3d>& points,
                                              const Plane& plane, bool both_sides);

}  // namespace arcstart::command_line
