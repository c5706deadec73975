// A line in one plate, scribed or milled, looks much like the gap between two.
#pragma once

#include "services/seam_finding/background/scan_view.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scales.hpp"

namespace arcstart::seam_finding {

// Of a butt joint: between its plates the stripes show a floor, at one depth and over a way across,
// where in a gap they fall on the farther plate's cut, at one place and ever deeper; and it is
// nearer to the plates' tops than to the background they lie on. A backing, which is no thicker
// than the plates, and the table itself lie deeper. False where no background is seen beside the
// joint.
bool shows_floor_near_top(const ScanView& scan, const Joint& joint, const Scales& scales);

}  // namespace arcstart::seam_finding
