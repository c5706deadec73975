// Crossing faces that are no outside corner of two plates but two sides of a block.
#pragma once

#include <vector>

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// Where a face that closes one of the seam's ends shows metal deeper behind both plates than a
// plate is thick, or than half the plate's width, as far as that was seen: two plates that meet
// show there their cuts, and nothing between them. faces: with normals toward the sensor.
bool is_edge_of_block(const ScanCloud& cloud, const std::vector<Face>& faces, const Joint& joint,
                      const Scales& scales);

}  // namespace arcstart::seam_finding
