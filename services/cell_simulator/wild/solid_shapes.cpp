#include "services/cell_simulator/wild/solid_shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "services/cell_simulator/scene/tool_shapes.hpp"

namespace arcstart::cell_simulator {
namespace {

// Six times the volume, below 0 where the mesh is inside out.
double six_volumes(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += (mesh.corners[a] - mesh.corners[0])
               .dot((mesh.corners[b] - mesh.corners[0]).cross(mesh.corners[c] - mesh.corners[0]));
  return sum;
}

int sides_of(double radius) { return static_cast<int>(circle({0, 0}, radius).size()); }

TriangleMesh make_cable(const WildSolid& solid) {
  constexpr int sides = 24;
  const double radius = solid.size_mm[0];
  TriangleMesh mesh;
  for (std::size_t i = 0; i < solid.points_mm.size(); ++i) {
    const Eigen::Vector3d at(solid.points_mm[i].data());
    RigidTransform pose = RigidTransform::Identity();
    pose.translation() = at;
    append(mesh, transformed(make_sphere(radius, 2), pose));
    if (i + 1 == solid.points_mm.size()) break;
    const Eigen::Vector3d way = Eigen::Vector3d(solid.points_mm[i + 1].data()) - at;
    if (way.norm() < 1e-6) continue;
    pose.linear() =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), way).toRotationMatrix();
    append(mesh, transformed(make_prism(sides, radius, 0, way.norm()), pose));
  }
  return mesh;
}

TriangleMesh own_mesh(const WildSolid& solid) {
  const auto& [a, b, c] = solid.size_mm;
  if (solid.kind == "block") return make_box({-a / 2, -b / 2, -c / 2}, {a / 2, b / 2, c / 2});
  if (solid.kind == "round") return make_prism(sides_of(b), b, -a / 2, a / 2);
  if (solid.kind == "hexagon") return make_prism(6, b, -a / 2, a / 2);
  if (solid.kind == "ball") return make_sphere(a, a > 3 ? 3 : 2);
  if (solid.kind == "hammer") return make_hammer();
  if (solid.kind == "pliers") return make_pliers();
  throw SceneError("solids: kind " + solid.kind +
                   " is none of block, round, hexagon, ball, cable, hammer, pliers");
}

using Outline = std::vector<Eigen::Vector3d>;  // convex, flat

// Parts an outline at x = at.
void part(const Outline& outline, double at, Outline& below, Outline& above) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector3d &p = outline[i], &q = outline[(i + 1) % outline.size()];
    (p.x() <= at ? below : above).push_back(p);
    if ((p.x() <= at) == (q.x() <= at)) continue;
    Eigen::Vector3d middle = p + (q - p) * ((at - p.x()) / (q.x() - p.x()));
    middle.x() = at;
    below.push_back(middle);
    above.push_back(middle);
  }
}

void append(TriangleMesh& mesh, const Outline& outline) {
  const int first = static_cast<int>(mesh.corners.size());
  mesh.corners.insert(mesh.corners.end(), outline.begin(), outline.end());
  for (int i = 1; i + 1 < static_cast<int>(outline.size()); ++i)
    mesh.triangles.push_back({first, first + i, first + i + 1});
}

}  // namespace

TriangleMesh loft(const Rings& section, const std::vector<std::vector<Eigen::Vector3d>>& layers) {
  TriangleMesh mesh;
  for (const auto& layer : layers)
    mesh.corners.insert(mesh.corners.end(), layer.begin(), layer.end());
  const int count = static_cast<int>(layers.at(0).size());
  const int last = count * (static_cast<int>(layers.size()) - 1);
  for (const auto& [a, b, c] : triangulate(section)) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({last + a, last + b, last + c});
  }
  for (int layer = 0; layer < last; layer += count) {
    int first = layer;
    for (const auto& ring : section) {
      const int n = static_cast<int>(ring.size());
      for (int i = 0; i < n; ++i) {
        const int p = first + i, q = first + (i + 1) % n;
        mesh.triangles.push_back({p, q, q + count});
        mesh.triangles.push_back({p, q + count, p + count});
      }
      first += n;
    }
  }
  if (six_volumes(mesh) < 0)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

TriangleMesh make_capsule(double length, double radius) {
  TriangleMesh mesh = make_sphere(radius, radius > 3 ? 4 : 3);
  const double half = std::max(0.0, length / 2 - radius);
  for (Eigen::Vector3d& corner : mesh.corners)
    corner.x() += corner.x() > 0 ? half : corner.x() < 0 ? -half : 0;
  return mesh;
}

TriangleMesh sliced(const TriangleMesh& mesh, double step) {
  TriangleMesh result;
  for (const auto& [a, b, c] : mesh.triangles) {
    Outline left{mesh.corners[a], mesh.corners[b], mesh.corners[c]};
    const auto [low, high] = std::minmax({left[0].x(), left[1].x(), left[2].x()});
    for (double at = (std::floor(low / step) + 1) * step; at < high; at += step) {
      Outline below, above;
      part(left, at, below, above);
      append(result, below);
      left = std::move(above);
    }
    append(result, left);
  }
  return result;
}

TriangleMesh mesh_of(const WildSolid& solid) {
  if (solid.kind == "cable") return make_cable(solid);
  const auto& q = solid.quaternion;
  return transformed(own_mesh(solid), make_transform(Eigen::Vector3d(solid.position_mm.data()),
                                                     {q[0], q[1], q[2], q[3]}));
}

}  // namespace arcstart::cell_simulator
