// What lies about in a workshop; each in a frame of its own, lying on z = 0, mm.
#pragma once

#include <vector>

#include "services/cell_simulator/scene/triangle_mesh.hpp"

namespace arcstart::cell_simulator {

TriangleMesh make_hammer();  // its handle along x
TriangleMesh make_pliers();  // their handles along x

// A convex outline in the table's plane, counter-clockwise.
using Footprint = std::vector<Eigen::Vector2d>;

// The rectangle along the mesh's own x and y that holds it, grown by `margin`, where the transform
// puts it.
Footprint footprint(const TriangleMesh& mesh, const RigidTransform& transform, double margin);

// Do two convex outlines overlap? By separating axes.
bool overlap(const Footprint& a, const Footprint& b);

}  // namespace arcstart::cell_simulator
