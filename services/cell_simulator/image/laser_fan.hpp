// The laser's fan cast onto a scene: which lines it lights, and which the light mirrored from them
// lights again.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/cell_simulator/scene/scene.hpp"

namespace arcstart::cell_simulator {

// A sheet of light: the rays from a source in one plane, within an angle about a direction.
struct LightSheet {
  Eigen::Vector3d source;     // mm
  Eigen::Vector3d normal;     // of the sheet's plane, unit
  Eigen::Vector3d direction;  // its middle, unit, in the plane
  double half_angle;          // rad, below a right angle
};

// A straight line of light on one triangle.
struct LitLine {
  Eigen::Vector3d begin, end;  // mm
  Eigen::Vector3d sheet_normal;
  Eigen::Vector3d source;  // of the light, mirrored for a ghost
  int triangle;
  double
      share;  // of the sheet's light that comes here; of a ghost's what the first surface mirrors
  // Sigma by which a glossy surface has widened the sheet where it meets the line's ends; mm, 0 for
  // a direct line.
  double spread_begin, spread_end;
  bool ghost;
};

// What the sheet lights directly: in every direction the nearest triangle. Exact: shadow edges
// included. Parted where an object's band begins or ends.
std::vector<LitLine> cast(const Scene& scene, const LightSheet& sheet);

// What the light lights again that the surfaces under `direct` mirror: each line's source is
// mirrored in its triangle's plane, and the mirrored sheet is cast through the line. Lines of less
// than `least_share` are left out.
std::vector<LitLine> cast_mirrored(const Scene& scene, const std::vector<LitLine>& direct,
                                   double least_share);

}  // namespace arcstart::cell_simulator
