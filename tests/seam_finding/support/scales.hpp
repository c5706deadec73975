// Scales of a cloud made by a test.
#pragma once

#include "services/seam_finding/model/scales.hpp"

namespace arcstart::seam_finding {

// mm.
inline Scales scales_of_test(double spacing, double tolerance, double noise = 0.05) {
  Scales scales;
  scales.spacing = spacing;
  scales.tolerance = tolerance;
  scales.noise = noise;
  return scales;
}

}  // namespace arcstart::seam_finding
