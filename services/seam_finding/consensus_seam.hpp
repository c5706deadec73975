// The seam of a cloud without stripes, where nothing but repetition tells a joint from chance.
#pragma once

#include <cstdint>

#include "services/seam_finding/background/background.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// Planes can be laid through rough or curved surfaces in many ways, and some of them meet like the
// plates of a joint. A real joint is found again when the planes are drawn anew, and when a point
// may lie farther from its plane. Finds the seam nine times with other random choices and a
// tolerance that rises from the cloud's own to twice that (unless it is set), and gives the answer
// on which two thirds of them agree; refuses, with all the seams listed, where there is none. The
// same seed gives the same answer.
SeamResult find_consensus_seam(const ScanCloud& scan, const Background& background,
                               const SeamFindingSettings& settings, std::uint64_t seed);

}  // namespace arcstart::seam_finding
