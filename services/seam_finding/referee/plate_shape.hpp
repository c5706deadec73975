// How a plate truly lies to the plane that is claimed for it: its bend along the seam, its tilt
// about it, its roundness.
#pragma once

#include "services/seam_finding/referee/plate_view.hpp"

namespace arcstart::seam_finding {

struct PlateShape {
  bool known = false;         // of enough places
  double tilt = 0;            // against the claimed plane, about the seam; rad
  double tilt_deviation = 0;  // standard; rad
  double curvature = 0;       // about the seam, positive where it is hollow; 1/mm
  double curvature_deviation = 0;
  double width = 0;                                // of what it is known by, away from the seam; mm
  double noise = 0;                                // of the places across the plate; mm, RMS
  double tolerance = 0;                            // what lies within is of the plate; mm
  Eigen::Vector3d bend = Eigen::Vector3d::Zero();  // height = bend0 + bend1 x + bend2 x^2, x in mm
  double middle = 0, half = 0;  // x counts along from the seam's middle, no farther than half

  // Of the plate over the claimed plane; mm.
  double height_at(double along, double away) const;
  double height_at_seam(double along) const;
};

// Least squares with what lies far off left out, between the claimed ends.
PlateShape shape_of(const PlateView& view, double length);

}  // namespace arcstart::seam_finding
