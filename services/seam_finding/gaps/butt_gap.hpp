// Of a butt joint a gap that is narrower than the distance of the centres kept, or than the light
// of a stripe can follow. No stripe alone tells where its plates end, all of them together do.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "services/seam_finding/fit/line_fit.hpp"

namespace arcstart::seam_finding {

// What a stripe shows near the joint, in the plates' frame; mm.
struct SeenPlace {
  double along = 0, across = 0;  // where the line of sight meets the plates' top
  double height = 0;             // over it
};

struct ButtGapSearch {
  double across = 0, middle = 0,
         slope = 0;  // of the joint about: across = .. + slope (along - middle)
  // Of the line of sight in a section across the joint: mm across for each mm down. Not 0.
  double sight = 0.78;
  double noise = 0.05;  // of the heights, standard deviation; mm
  double widest = 4;    // mm
};

// The sight into a square gap falls on the farther plate's cut, the deeper the nearer it passes to
// the nearer plate's edge: a sawtooth, which the stripe's smoothing rounds. Its place, width and
// rounding are fitted to the heights by robust least squares. Returns the plates' borders, the one
// at smaller `across` first; nothing where the heights do not show such a gap.
std::optional<std::array<LineFit, 2>> fit_butt_gap(const std::vector<SeenPlace>& places,
                                                   const ButtGapSearch& search);

}  // namespace arcstart::seam_finding
