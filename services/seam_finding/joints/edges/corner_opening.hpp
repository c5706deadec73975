// Where the faces of an outside corner begin whose plates leave a notch between their edges.
#pragma once

#include <array>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// How far each face begins from the line in which the planes cross; mm, 0 where it reaches it, and
// for both where the stripes show no notch: between the faces they run over the plates' edges, no
// farther from the line than plates are thick, and at nothing else. faces: turned to the sensor.
std::array<double, 2> corner_opening(const ScanCloud& cloud,
                                     const std::array<const Face*, 2>& faces, const Line& line,
                                     const Scales& scales);

}  // namespace arcstart::seam_finding
