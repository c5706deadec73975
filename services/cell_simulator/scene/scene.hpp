// What stands in the simulated cell, and the truth about its seam.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "services/cell_simulator/scene/scene_settings.hpp"
#include "services/cell_simulator/scene/triangle_hierarchy.hpp"

namespace arcstart::cell_simulator {

class Scene {
 public:
  explicit Scene(std::vector<SceneObject> objects, std::optional<SeamTruth> seam = {});

  const std::vector<SceneObject>& objects() const { return objects_; }
  const std::optional<SeamTruth>& seam() const { return seam_; }
  const TriangleHierarchy& triangles() const { return triangles_; }
  // At a point of a triangle.
  const Surface& surface_at(int triangle, const Eigen::Vector3d& point) const {
    const SceneObject& object = objects_[triangles_.object_of(triangle)];
    return object.band && object.band->contains(point) ? object.band->surface : object.surface;
  }

 private:
  std::vector<SceneObject> objects_;
  std::optional<SeamTruth> seam_;
  TriangleHierarchy triangles_;  // of all objects
};

enum class SceneKind { background, workpiece };

// The empty table, or the same table (the same seed gives the same bumps) with the work and what
// lies about; or with a ball in its place, where there is no seam. Throws SceneError.
Scene make_scene(const SceneSettings& settings, SceneKind kind, std::uint64_t seed);

}  // namespace arcstart::cell_simulator
