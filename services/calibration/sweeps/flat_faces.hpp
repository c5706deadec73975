// Flat faces in a cloud of straight pieces.
#pragma once

#include <vector>

#include "common/geometry.hpp"

namespace arcstart::calibration {

struct FlatFace {
  Plane plane;             // in base
  Eigen::Vector3d centre;  // of its points, in base; mm
  int points = 0;
};

// The largest first, each of points within `tolerance` mm of its plane, taken out before the next
// is looked for; at most four, each with a tenth of all points at least. By random sampling with a
// fixed seed and least squares.
std::vector<FlatFace> flat_faces(const std::vector<Eigen::Vector3d>& points, double tolerance);

// The plane nearest to the points, by least squares; three of them at least.
FlatFace fit_face(const std::vector<Eigen::Vector3d>& points);

}  // namespace arcstart::calibration
