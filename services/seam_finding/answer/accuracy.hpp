// How well a seam is known from its plates' points.
#pragma once

#include <array>
#include <optional>

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// Across a seam between crossing plates their planes tell it, as far as the plates are fitted again
// beside it; between parallel ones their edges, and out of them the first plate's plane. What is
// common to a stripe (the position's noise) counts once a stripe, what is not once a point. Nothing
// where a plate is seen in too few places.
std::optional<SeamAccuracy> seam_accuracy(const ScanCloud& cloud, const Joint& joint,
                                          const std::array<SeamEnd, 2>& ends, const Scales& scales,
                                          const SeamFindingSettings& settings);

// Adds what the robot errs by: standard deviation of its positions, each axis, from end to end of
// the seam as if they knew nothing of each other; mm.
void add_robot_accuracy(double deviation_mm, SeamResult& seam);

}  // namespace arcstart::seam_finding
