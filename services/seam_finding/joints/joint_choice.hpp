// Which of the faces make the wanted joint, and whether one of them may be answered.
#pragma once

#include <optional>
#include <vector>

#include "services/seam_finding/cloud/thinned_cloud.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// The joints of the wanted types between the faces, best first; the best is measured again beside
// its seam and answered, unless something speaks against it or another comes too near. Fills in the
// verdict with its reason, the alternatives and, where found, the seam. Faces, and `left`, the
// points that are not background, are of the thinned scan where that is less than the whole.
std::optional<Joint> choose_seam(SeamResult& result, const ScanCloud& scan,
                                 const ThinnedCloud& thinned, const std::vector<int>& left,
                                 std::vector<Face> faces, const Scales& scales,
                                 const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
