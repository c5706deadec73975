#include "services/cell_simulator/scene/tool_shapes.hpp"

#include <Eigen/Geometry>
#include <limits>

namespace arcstart::cell_simulator {
namespace {

RigidTransform turned(double degrees, const Eigen::Vector3d& at) {
  RigidTransform transform = RigidTransform::Identity();
  transform.translation() = at;
  transform.rotate(Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Eigen::Vector3d::UnitZ()));
  return transform;
}

// Does the normal of some edge of a keep all of a on one side and all of b on the other?
bool parted_by_edge_of(const Footprint& a, const Footprint& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector2d edge = a[(i + 1) % a.size()] - a[i];
    const Eigen::Vector2d outward(edge.y(), -edge.x());
    bool parted = true;
    for (const auto& p : b) parted = parted && outward.dot(p - a[i]) > 0;
    if (parted) return true;
  }
  return false;
}

}  // namespace

TriangleMesh make_hammer() {
  TriangleMesh hammer = make_box({-13, -30, 0}, {13, 30, 26});  // head, lying across
  RigidTransform poll = turned(90, {0, 0, 13});
  append(hammer, transformed(make_prism(8, 14, 30, 52), poll));
  append(hammer, transformed(make_plate({{-13, 0}, {13, 0}, {3, 40}, {-3, 40}}, 0, 26),
                             turned(180, {0, -30, 0})));
  append(hammer, transformed(make_prism(8, 11, 13, 190), turned(0, {0, 0, 11})));  // handle
  return hammer;
}

TriangleMesh make_pliers() {
  Footprint joint;
  for (int i = 0; i < 16; ++i)
    joint.emplace_back(16 * std::cos(i * EIGEN_PI / 8), 16 * std::sin(i * EIGEN_PI / 8));
  TriangleMesh pliers = make_plate(joint, 0, 13);
  for (const double side : {-1.0, 1.0}) {
    append(pliers,
           transformed(make_box({8, -6, 1}, {135, 6, 12}), turned(side * 9, {0, side * 3, 0})));
    append(pliers, transformed(make_plate({{-52, -3}, {-8, -9}, {-8, 4}, {-52, 2}}, 1.5, 11.5),
                               turned(side * 6, {0, side * 4, 0})));
  }
  return pliers;
}

Footprint footprint(const TriangleMesh& mesh, const RigidTransform& transform, double margin) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()),
                  high = -low;
  for (const auto& corner : mesh.corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  low.array() -= margin;
  high.array() += margin;
  Footprint result;
  for (const auto& [x, y] : {std::pair(low.x(), low.y()),
                             {high.x(), low.y()},
                             {high.x(), high.y()},
                             {low.x(), high.y()}})
    result.push_back((transform * Eigen::Vector3d(x, y, 0)).head<2>());
  return result;
}

bool overlap(const Footprint& a, const Footprint& b) {
  return !parted_by_edge_of(a, b) && !parted_by_edge_of(b, a);
}

}  // namespace arcstart::cell_simulator
