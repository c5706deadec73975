// The edges at which plates side by side end toward each other, stripe by stripe.
#pragma once

#include <array>
#include <optional>

#include "services/seam_finding/referee/plate_view.hpp"

namespace arcstart::seam_finding {

// The plates that end at the seam: both of a butt joint or groove, the upper one of a lap.
std::array<bool, 2> end_at_seam(const SeamResult& seam);

// Where a stripe leaves a plate toward the seam, away from it; nothing where it runs on across, or
// does not show the plate.
std::optional<double> edge_in(const PlateView& view, const StripeOnPlate& stripe);

struct SeamEdges {
  int stripes = 0;                  // between the claimed ends that show the plate beside the seam
  int leaving = 0;                  // of those, at the place where the plate is claimed to begin
  bool known = false;               // their course, of enough stripes
  double at_start = 0, at_end = 0;  // farther from the seam than claimed; mm
};
SeamEdges edges_of(const PlateView& view, double length);

// Where nearly all stripes leave the plate at the seam, one that runs on across is of no seam:
// beyond its end, over a run-off tab. It counts as one that does not show the plate.
void leave_out_across(const SeamEdges& edges, PlateView& view);

}  // namespace arcstart::seam_finding
