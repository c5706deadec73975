// From the seam as it was searched to the seam as it is to be welded.
#pragma once

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// mm, how far a place lies outside settings.search_box_mm; 0 within it, or where none is set.
double outside_box(const SeamFindingSettings& settings, const Eigen::Vector3d& place);

// Start and end change places, with all that is known of each; the torch is placed anew.
void exchange_ends(const SeamFindingSettings& settings, SeamResult& seam);

// Of a found seam, after the referee, who knows the scan's own order. Refuses it where an end lies
// outside the search box, or where a search direction is set and the seam runs at more than 60 deg
// to it; exchanges its ends where the weld starts at the far one; withdraws an end that is known
// less well than end_deviation_max_mm.
void set_weld_order(const SeamFindingSettings& settings, SeamResult& seam);

}  // namespace arcstart::seam_finding
