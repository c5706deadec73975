// All pairs of faces that may be the wanted joint.
#pragma once

#include <vector>

#include "services/seam_finding/background/scan_view.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// The joints of the wanted types between the faces, crossing and parallel, best first; those with a
// flaw behind those without. faces: of the points for the search.
std::vector<Joint> find_joints(const ScanView& scan, std::vector<Face> faces, const Scales& scales,
                               const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
