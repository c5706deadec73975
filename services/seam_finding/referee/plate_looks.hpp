// What of a plate's view is the plate, and what lies behind or before it.
#pragma once

#include "services/seam_finding/referee/plate_shape.hpp"
#include "services/seam_finding/referee/plate_view.hpp"

namespace arcstart::seam_finding {

// Sets each place's look by its height over the shape, what each stripe shows beside the seam, and
// how wide the plate is; adds places between neighbours that look alike. length: of the seam; mm.
void set_looks(const PlateShape& shape, double length, PlateView& view);

}  // namespace arcstart::seam_finding
