// Where a seam between parallel plates starts and ends.
#pragma once

#include "services/seam_finding/accuracy.hpp"
#include "services/seam_finding/ends.hpp"
#include "services/seam_finding/joints.hpp"

namespace arcstart {

// As find_end(), each plate by the stripes' crossings of its own border and by its own edge. Where
// no stripe crosses an edge, a plate ends anywhere between the last stripe that shows it and the
// next. stations: as of stations_by_border().
SeamEnd find_flat_end(const ScanCloud& cloud, const Joint& joint,
                      const std::array<Stations, 2>& stations, SeamSide side,
                      const EndSearch& search);

// As seam_accuracy(): along the seam from the ends, across it from the borders, out of the plates
// from the first plate's plane.
std::optional<SeamAccuracy> flat_accuracy(const Joint& joint,
                                          const std::array<PlaneAccuracy, 2>& accuracies,
                                          const SeamEnd& start, const SeamEnd& end);

}  // namespace arcstart
