// Measures of a scene's meshes, taken from their corners.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>
#include <string>
#include <utility>

#include "services/cell_simulator/scene/scene.hpp"

namespace arcstart::test {

using namespace cell_simulator;

constexpr double degree = std::numbers::pi / 180;

// For what has nothing to do with the table: one that is quickly made.
inline SceneSettings with_coarse_table() {
  SceneSettings settings;
  settings.table_pitch_mm = 70;
  return settings;
}

inline const SceneObject& object(const Scene& scene, const std::string& name) {
  for (const SceneObject& candidate : scene.objects())
    if (candidate.name == name) return candidate;
  FAIL("no " << name);
  throw 0;
}

inline bool has(const Scene& scene, const std::string& name) {
  for (const SceneObject& candidate : scene.objects())
    if (candidate.name == name) return true;
  return false;
}

inline bool same(const TriangleMesh& a, const TriangleMesh& b) {
  return a.triangles == b.triangles && a.corners == b.corners;
}

// The face of a plate whose outward normal is nearest to a direction: a point of it and that
// normal.
struct FlatFace {
  Eigen::Vector3d point, normal;
};
inline FlatFace face_towards(const TriangleMesh& mesh, const Eigen::Vector3d& direction) {
  FlatFace best;
  double most = -2;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d normal =
        (mesh.corners[b] - mesh.corners[a]).cross(mesh.corners[c] - mesh.corners[a]).normalized();
    if (normal.dot(direction) > most) {
      most = normal.dot(direction);
      best = {mesh.corners[a], normal};
    }
  }
  return best;
}

inline std::pair<double, double> extent(const TriangleMesh& mesh,
                                        const Eigen::Vector3d& direction) {
  double low = 1e9, high = -1e9;
  for (const auto& corner : mesh.corners) {
    low = std::min(low, direction.dot(corner));
    high = std::max(high, direction.dot(corner));
  }
  return {low, high};
}

}  // namespace arcstart::test
