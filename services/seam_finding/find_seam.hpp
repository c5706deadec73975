// From the points of a scan to the weld seam and where it starts (paper 5).
#pragma once

#include <cstdint>

#include "services/seam_finding/background/segmentation.hpp"
#include "services/seam_finding/cloud/downsampled_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// The whole way: background, planes, joints, refinement beside the seam, ends. Refuses with a
// reason when in doubt. The result depends on nothing but the arguments; seed: the scan's id.
SeamResult find_seam(const ScanCloud& cloud, const Background& background,
                     const SeamFindingSettings& settings, std::uint64_t seed);
// The same of a scan that is segmented and downsampled; leaves the result's background to the
// segmentation.
SeamResult find_seam(const ScanCloud& cloud, const Segmentation& segmentation,
                     const DownsampledCloud& fewer, const SeamFindingSettings& settings,
                     std::uint64_t seed);

}  // namespace arcstart::seam_finding
