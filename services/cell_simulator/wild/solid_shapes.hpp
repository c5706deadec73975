// Closed meshes of what lies in a scene of the wild; mm.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/cell_simulator/scene/triangle_mesh.hpp"
#include "services/cell_simulator/wild/polygon.hpp"
#include "services/cell_simulator/wild/wild_scene.hpp"

namespace arcstart::cell_simulator {

// A section drawn through layers: each gives every corner of the rings its place. Caps on the first
// and the last; turned inside out where the layers are so.
TriangleMesh loft(const Rings& section, const std::vector<std::vector<Eigen::Vector3d>>& layers);

// About the origin along x, its ends round, as finely as 0.01 mm up to a radius of 5 mm.
TriangleMesh make_capsule(double length, double radius);

// The mesh parted at every multiple of `step` in x, so that it may be bent.
TriangleMesh sliced(const TriangleMesh& mesh, double step);

// In base. Throws SceneError where there is no such kind.
TriangleMesh mesh_of(const WildSolid& solid);

}  // namespace arcstart::cell_simulator
