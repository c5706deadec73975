// Where a seam starts and ends: from the edges of both its plates.
#pragma once

#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/visibility/plate_stripes.hpp"

namespace arcstart::seam_finding {

// The seam begins where both plates have begun: at the later of their edges, or, the likelier the
// nearer these lie, at what both tell of flush ones. A plate whose edge no stripe crosses begins
// somewhere between the last stripe that does not show it at the seam and the first that does.
// stripes: of the plates, in the same tolerance; along their line all places are counted.
SeamEnd find_end(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                 const Course& course, const std::array<PlateStripes, 2>& stripes, SeamSide side,
                 const EndSearch& search);

}  // namespace arcstart::seam_finding
