// Triangles at random and rays through them, the slow and simple way: what the fast code is judged
// by.
#pragma once

#include <Eigen/Dense>
#include <limits>

#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/scene/triangle_mesh.hpp"

namespace arcstart::test {

using namespace cell_simulator;

inline Eigen::Vector3d random_point(RandomStream& random, double half) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

inline TriangleMesh random_triangles(RandomStream& random, int count, double half, double size) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d middle = random_point(random, half);
    for (int k = 0; k < 3; ++k) mesh.corners.push_back(middle + random_point(random, size));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

// Share of the way from `from` to `to` at which the ray meets the triangle, by solving for it;
// infinite for none.
inline double share_to(const TriangleMesh& mesh, const std::array<int, 3>& triangle,
                       const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const auto& [a, b, c] = triangle;
  Eigen::Matrix3d system;
  system << mesh.corners[b] - mesh.corners[a], mesh.corners[c] - mesh.corners[a], from - to;
  const Eigen::Vector3d x = system.fullPivLu().solve(from - mesh.corners[a]);
  const bool inside = x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1 && x[2] > 0;
  return inside ? x[2] : std::numeric_limits<double>::infinity();
}

inline double nearest_share(const TriangleMesh& mesh, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& triangle : mesh.triangles)
    nearest = std::min(nearest, share_to(mesh, triangle, from, to));
  return nearest;
}

}  // namespace arcstart::test
