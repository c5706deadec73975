// From the points of a scan to the weld seam and where it starts (paper 5).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "services/seam_finding/background/background.hpp"
#include "services/seam_finding/background/segmentation.hpp"
#include "services/seam_finding/cloud/thinned_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// The whole way: background, planes, joints, refit beside the seam, start. Refuses with a reason
// when in doubt. The result depends on nothing but the arguments; seed: the scan's id.
SeamResult find_seam(const ScanCloud& scan, const Background& background,
                     const SeamFindingSettings& settings, std::uint64_t seed);
// The same of a scan that is divided and thinned; leaves the result's background to the division.
SeamResult find_seam(const ScanCloud& scan, const Division& division, const ThinnedCloud& thinned,
                     const SeamFindingSettings& settings, std::uint64_t seed);

}  // namespace arcstart::seam_finding
