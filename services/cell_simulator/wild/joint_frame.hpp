// How the two plates of a joint lie in the work's frame.
#pragma once

#include <Eigen/Core>

#include "services/cell_simulator/wild/plate_form.hpp"
#include "services/cell_simulator/wild/wild_scene.hpp"

namespace arcstart::cell_simulator {

// From a plate's coordinates (s, t, d) to the work's. What grows along the seam, gap and mismatch,
// shifts it by so much for each mm of s.
struct PlateFrame {
  Eigen::Vector3d origin, along, away, depth;
  SeamEdge edge;

  Eigen::Vector3d at(const Eigen::Vector3d& std) const {
    return origin + std.x() * along + std.y() * away + std.z() * depth;
  }
  Eigen::Vector3d normal() const;  // unit, out of the metal
};

PlateFrame first_frame(const WildWork& work);
PlateFrame second_frame(const WildWork& work);

// Gap and mismatch at a place along the seam.
double gap_at(const WildWork& work, double s);
double mismatch_at(const WildWork& work, double s);

}  // namespace arcstart::cell_simulator
