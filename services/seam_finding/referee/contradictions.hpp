// What speaks against a seam as a whole, whatever its ends are.
#pragma once

#include <array>
#include <optional>

#include "services/seam_finding/model/reason.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/referee/plate_shape.hpp"
#include "services/seam_finding/referee/plate_view.hpp"
#include "services/seam_finding/referee/seam_edges.hpp"

namespace arcstart::seam_finding {

bool is_outside_corner(const SeamResult& seam);

// The first of: a plate that is not there, is turned, round or no wider than an edge; plates side
// by side that do not end at the seam; an outside corner's plate that is a cut; stripes along it
// that do not show both plates. None where the stripes bear the seam out. edges: of the plates that
// end at the seam. spacing: of the stripes along the seam; mm.
Reason contradiction_of(const SeamResult& seam, const std::array<PlateView, 2>& views,
                        const std::array<PlateShape, 2>& shapes,
                        const std::array<std::optional<SeamEdges>, 2>& edges, double spacing);

}  // namespace arcstart::seam_finding
