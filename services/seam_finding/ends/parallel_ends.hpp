// Where a seam between parallel plates starts and ends.
#pragma once

#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam_end.hpp"

namespace arcstart::seam_finding {

// As find_end(), each plate by the stripes' crossings of its own border and by its own edge. Where
// no stripe crosses an edge, a plate ends anywhere between the last stripe that shows it and the
// next. stations: as of stations_by_border().
SeamEnd find_flat_end(const ScanCloud& cloud, const Joint& joint,
                      const std::array<Stations, 2>& stations, SeamSide side,
                      const EndSearch& search);

}  // namespace arcstart::seam_finding
