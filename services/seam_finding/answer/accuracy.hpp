// How well a plate's plane, and the seam between two of them, are known from their points.
#pragma once

#include <array>
#include <optional>

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// Of a plate's plane beside the seam. What is common to a stripe (the position's noise) counts once
// a stripe, what is not once a point.
struct PlaneAccuracy {
  double middle = 0;       // place along the seam where it is known best; mm
  double height = 0;       // variance at the seam, in the middle; mm2
  double slope_along = 0;  // variance of its slope along the seam
  double slope_away = 0;   // variance of its slope away from it
  bool determined = false;

  double height_at(double along) const {
    return height + slope_along * (along - middle) * (along - middle);
  }
};

// From the points no farther than `distance` mm from the line. spacing: between stripes; mm.
PlaneAccuracy plane_accuracy(const ScanCloud& cloud, const JointPlate& plate,
                             const JointPlate& other, const Line& line, double distance_mm,
                             double spacing_mm);
std::array<PlaneAccuracy, 2> plane_accuracies(const ScanCloud& cloud, const Joint& joint,
                                              const Scales& scales,
                                              const SeamFindingSettings& settings);

// Nothing where a plate is seen in too few places. Across a crossing seam its two planes tell it.
std::optional<SeamAccuracy> crossing_accuracy(const Joint& joint,
                                              const std::array<PlaneAccuracy, 2>& accuracies,
                                              const std::array<SeamEnd, 2>& ends);

// The same between parallel plates: across the seam from the plates' edges, out of the plates from
// the first plate's plane.
std::optional<SeamAccuracy> parallel_accuracy(const Joint& joint,
                                              const std::array<PlaneAccuracy, 2>& accuracies,
                                              const std::array<SeamEnd, 2>& ends);

}  // namespace arcstart::seam_finding
