#include "services/cell_simulator/triangle_mesh.hpp"

#include <cmath>
#include <numbers>

namespace arcstart {

TriangleMesh make_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return make_plate(
      {{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}}, low.z(),
      high.z());
}

TriangleMesh make_plate(const std::vector<Eigen::Vector2d>& outline, double bottom, double top) {
  TriangleMesh mesh;
  const int n = static_cast<int>(outline.size());
  for (const auto& p : outline) mesh.corners.emplace_back(p.x(), p.y(), bottom);
  for (const auto& p : outline) mesh.corners.emplace_back(p.x(), p.y(), top);
  for (int i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i + 1, i});          // bottom, seen from below
    mesh.triangles.push_back({n, n + i, n + i + 1});  // top
  }
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.triangles.push_back({i, next, n + next});
    mesh.triangles.push_back({i, n + next, n + i});
  }
  return mesh;
}

TriangleMesh make_prism(int sides, double radius, double begin, double end) {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / sides;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  TriangleMesh mesh = make_plate(outline, begin, end);
  for (auto& corner : mesh.corners)
    corner = Eigen::Vector3d(corner.z(), corner.x(), corner.y());  // z to x
  return mesh;
}

TriangleMesh transformed(const TriangleMesh& mesh, const RigidTransform& transform) {
  TriangleMesh result = mesh;
  for (auto& corner : result.corners) corner = transform * corner;
  return result;
}

void append(TriangleMesh& mesh, const TriangleMesh& more) {
  const int first = static_cast<int>(mesh.corners.size());
  mesh.corners.insert(mesh.corners.end(), more.corners.begin(), more.corners.end());
  for (const auto& [a, b, c] : more.triangles)
    mesh.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace arcstart
