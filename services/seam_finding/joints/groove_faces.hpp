// Crossing faces that are no tee and no corner but the two sides of a groove.
#pragma once

#include <vector>

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// Where each of the two ends, away from the seam, at a convex edge along it to a plate's top, and
// the two tops are parallel within `parallel` (rad). A tee's or a corner's plates end at their own
// cuts, which face as many ways as the plates do. faces: with normals toward the sensor.
bool are_sides_of_groove(const ScanCloud& cloud, const std::vector<Face>& faces, const Joint& joint,
                         double parallel, const Scales& scales);

}  // namespace arcstart::seam_finding
