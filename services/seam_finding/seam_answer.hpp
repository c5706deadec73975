// What is answered of a joint: where it starts and ends, how sure that is, its course and the
// torch.
#pragma once

#include "services/seam_finding/find_seam.hpp"
#include "services/seam_finding/joints.hpp"
#include "services/seam_finding/scales.hpp"

namespace arcstart {

CourseSearch course_search(const Scales& scales);

// Fills in a found seam.
void answer(SeamResult& result, const ScanCloud& scan, const Joint& joint, const Scales& scales,
            const SeamFindingSettings& settings);

}  // namespace arcstart
