#include "services/cell_simulator/scene/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace arcstart::cell_simulator {

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

TriangleMesh make_sphere(double radius, int partings) {
  const double g = std::numbers::phi;
  TriangleMesh mesh;
  mesh.corners = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int parting = 0; parting < partings; ++parting) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [entry, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                       static_cast<int>(mesh.corners.size()));
      if (is_new)
        mesh.corners.push_back((mesh.corners[static_cast<std::size_t>(a)].normalized() +
                                mesh.corners[static_cast<std::size_t>(b)].normalized()) /
                               2);
      return entry->second;
    };
    std::vector<std::array<int, 3>> parts;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const std::array<int, 3>& part : {std::array{a, ab, ca}, std::array{b, bc, ab},
                                             std::array{c, ca, bc}, std::array{ab, bc, ca}})
        parts.push_back(part);
    }
    mesh.triangles = std::move(parts);
  }
  for (Eigen::Vector3d& corner : mesh.corners) corner = radius * corner.normalized();
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

}  // namespace arcstart::cell_simulator
