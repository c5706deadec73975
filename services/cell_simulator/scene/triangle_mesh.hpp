// Triangle meshes; mm. Corners run counter-clockwise seen from outside.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "common/geometry.hpp"

namespace arcstart::cell_simulator {

struct TriangleMesh {
  std::vector<Eigen::Vector3d> corners;
  std::vector<std::array<int, 3>> triangles;  // indices into corners
};

// Between two opposite corners, edges along the axes.
TriangleMesh make_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

// A regular prism of n >= 3 sides about the x axis, from x = begin to x = end.
TriangleMesh make_prism(int sides, double radius, double begin, double end);

// About the origin: an icosahedron whose faces are parted in four so many times.
TriangleMesh make_sphere(double radius, int partings);

// A convex outline (x, y), counter-clockwise, raised from z = bottom to z = top.
TriangleMesh make_plate(const std::vector<Eigen::Vector2d>& outline, double bottom, double top);

TriangleMesh transformed(const TriangleMesh& mesh, const RigidTransform& transform);
void append(TriangleMesh& mesh, const TriangleMesh& more);

}  // namespace arcstart::cell_simulator
