// The root gap of a tee, an inside corner or a lap, stripe by stripe. In the plates' planes nothing
// tells of it; it shows in the corner, where the light goes on under the plate that stands off.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

struct RootGap {
  double width = 0;      // from the edge of the plate that stands off to the other's face; mm
  double deviation = 0;  // standard; mm
};

// Of each stripe of the cloud; nothing where its corner was not seen well enough: spoilt, thinned
// out without its bends, or the light parted and the plate that goes on not seen behind the other's
// face. The planes' normals point out of the metal. `standing`: the plate that stands off the
// other; -1 where either may.
//
// Where the stripe runs through the corner in one piece the gap is told by the area that it
// encloses behind the standing plate's face: smoothing rounds the stripe's turns but keeps that
// area, a triangle between the edge, where the line of sight past it meets the other plate, and the
// corner of the planes. Half a millimetre cannot be told from none: reflections in the corner shift
// the stripe as much, and the deviation says so. Where the light is parted, it is the height of the
// standing plate's end.
std::vector<std::optional<RootGap>> root_gaps(const ScanCloud& cloud,
                                              const std::array<JointPlate, 2>& plates,
                                              const Line& line, int standing = -1);

}  // namespace arcstart::seam_finding
