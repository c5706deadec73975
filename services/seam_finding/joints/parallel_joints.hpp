// Joints of plates whose faces lie in one plane or in parallel ones: lap, butt and V-groove. Their
// seam is no plane's intersection; it is drawn through the places where stripes leave one plate for
// the other.
#pragma once

#include <vector>

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// All such joints between the faces and within each of them; with a flaw where something speaks
// against one. The faces' normals point to the sensor. Empty where the way of the search is not
// known.
std::vector<Joint> find_parallel_joints(const ScanCloud& cloud, const std::vector<Face>& faces,
                                        const Scales& scales, const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
