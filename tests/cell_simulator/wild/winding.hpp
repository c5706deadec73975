// How often a closed mesh winds around a point, by brute force over its triangles.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "services/cell_simulator/scene/triangle_mesh.hpp"

namespace arcstart::cell_simulator {

// The solid angles of its triangles (van Oosterom and Strackee 1983): 0 outside, 1 within; of
// solids that overlap the number that hold the point.
inline double winding(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  double sum = 0;
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Eigen::Vector3d a = mesh.corners[ia] - point, b = mesh.corners[ib] - point,
                          c = mesh.corners[ic] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

// Does the segment between two points meet a triangle of the mesh?
inline bool meets(const TriangleMesh& mesh, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to) {
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    Eigen::Matrix3d sides;
    sides << mesh.corners[ib] - mesh.corners[ia], mesh.corners[ic] - mesh.corners[ia], from - to;
    if (std::abs(sides.determinant()) < 1e-12) continue;
    const Eigen::Vector3d share = sides.inverse() * (from - mesh.corners[ia]);
    if (share.minCoeff() >= 0 && share.x() + share.y() <= 1 && share.z() <= 1) return true;
  }
  return false;
}

}  // namespace arcstart::cell_simulator
