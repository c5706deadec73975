// What stands in the simulated cell, and the truth about its seam.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "services/cell_simulator/scene/scene_settings.hpp"
#include "services/cell_simulator/scene/triangle_hierarchy.hpp"
#include "services/cell_simulator/scene/triangle_mesh.hpp"

namespace arcstart::cell_simulator {

// How a surface answers the laser's light.
struct Surface {
  double albedo = 0.4;          // share sent back diffusely
  double mottling = 0;          // relative change of the albedo over patches of a few mm
  double speckle = 1;           // times the sensor's speckle contrast
  double specular_share = 0;    // share mirrored
  double gloss_spread_rad = 0;  // standard deviation of the mirrored direction
};

struct SceneObject {
  std::string name;
  TriangleMesh mesh;  // in base; mm
  Surface surface;
};

// The true seam in base; mm and rad. It runs in the search direction.
struct SeamTruth {
  std::string joint_type;  // tee, outside_corner, lap, butt, v
  Eigen::Vector3d start, end, direction;
  std::array<Eigen::Vector3d, 2> normals;  // of both plates, unit, out of the metal
  double angle;                            // between the plates' faces on the open side
};

class Scene {
 public:
  explicit Scene(std::vector<SceneObject> objects, std::optional<SeamTruth> seam = {});

  const std::vector<SceneObject>& objects() const { return objects_; }
  const std::optional<SeamTruth>& seam() const { return seam_; }
  const TriangleHierarchy& triangles() const { return triangles_; }
  const Surface& surface_of(int triangle) const {
    return objects_[triangles_.object_of(triangle)].surface;
  }

 private:
  std::vector<SceneObject> objects_;
  std::optional<SeamTruth> seam_;
  TriangleHierarchy triangles_;  // of all objects
};

// Impossible settings or an STL file that cannot be read; says which and what to do.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class SceneKind { background, workpiece };

// The empty table, or the same table (the same seed gives the same bumps) with the work and what
// lies about; or with a ball in its place, where there is no seam. Throws SceneError.
Scene make_scene(const SceneSettings& settings, SceneKind kind, std::uint64_t seed);

}  // namespace arcstart::cell_simulator
