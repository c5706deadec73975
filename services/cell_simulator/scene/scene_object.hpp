// What a scene is made of.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

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

// What of an object lies between two parallel planes and answers light in a way of its own, as
// steel does that was ground beside a seam.
struct SurfaceBand {
  Eigen::Vector3d middle;  // a point midway between the planes, in base; mm
  Eigen::Vector3d across;  // unit, square to the planes
  double half_width;       // mm
  Surface surface;

  double off_middle(const Eigen::Vector3d& point) const { return across.dot(point - middle); }
  bool contains(const Eigen::Vector3d& point) const {
    return std::abs(off_middle(point)) < half_width;
  }
};

struct SceneObject {
  std::string name;
  TriangleMesh mesh;  // in base; mm
  Surface surface;
  std::optional<SurfaceBand> band = {};
};

// The true seam in base; mm and rad. It runs in the search direction.
struct SeamTruth {
  std::string joint_type;  // tee, outside_corner, lap, butt, v
  Eigen::Vector3d start, end, direction;
  std::array<Eigen::Vector3d, 2> normals;  // of both plates, unit, out of the metal
  double angle;                            // between the plates' faces on the open side
};

// Impossible settings or an STL file that cannot be read; says which and what to do.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace arcstart::cell_simulator
