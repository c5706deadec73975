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

// Parts a triangle at x = at; the parts below come first.
void part(const std::array<Eigen::Vector3d, 3>& t, double at,
          std::vector<std::array<Eigen::Vector3d, 3>>& below,
          std::vector<std::array<Eigen::Vector3d, 3>>& above) {
  std::vector<Eigen::Vector3d> low, high;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d &p = t[i], &q = t[(i + 1) % 3];
    (p.x() <= at ? low : high).push_back(p);
    if ((p.x() <= at) != (q.x() <= at)) {
      Eigen::Vector3d middle = p + (q - p) * ((at - p.x()) / (q.x() - p.x()));
      middle.x() = at;
      low.push_back(middle);
      high.push_back(middle);
    }
  }
  for (std::size_t i = 1; i + 1 < low.size(); ++i) below.push_back({low[0], low[i], low[i + 1]});
  for (std::size_t i = 1; i + 1 < high.size(); ++i)
    above.push_back({high[0], high[i], high[i + 1]});
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
  using Corners = std::array<Eigen::Vector3d, 3>;
  TriangleMesh result;
  for (const auto& [a, b, c] : mesh.triangles) {
    std::vector<Corners> left{{mesh.corners[a], mesh.corners[b], mesh.corners[c]}};
    double low = left[0][0].x(), high = low;
    for (const Eigen::Vector3d& p : left[0])
      low = std::min(low, p.x()), high = std::max(high, p.x());
    for (double at = (std::floor(low / step) + 1) * step; at < high; at += step) {
      std::vector<Corners> below, above;
      for (const Corners& t : left) part(t, at, below, above);
      for (const Corners& t : below) {
        const int first = static_cast<int>(result.corners.size());
        result.corners.insert(result.corners.end(), t.begin(), t.end());
        result.triangles.push_back({first, first + 1, first + 2});
      }
      left = std::move(above);
    }
    for (const Corners& t : left) {
      const int first = static_cast<int>(result.corners.size());
      result.corners.insert(result.corners.end(), t.begin(), t.end());
      result.triangles.push_back({first, first + 1, first + 2});
    }
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
