// Numbers of what is said of a seam. Behind the dash stands the source; "bench": none is known,
// scripts/bench seam judges the number.
#pragma once

#include "common/geometry.hpp"
#include "services/seam_finding/cloud/constants.hpp"

namespace arcstart::seam_finding {

struct AnswerConstants {
  // mm; standard deviation of a plane's height that all its points have in common; and of the seam
  // across, whatever the number of its places - bench.
  double height_floor = 0.005, across_floor = 0.02;
  // mm; a seam that is nowhere farther from its line is straight - bench.
  double straight = 0.5;
  // Of the open angle, between the torch and a plate, at least - none known.
  double least_torch_share = 0.1;
  // rad; between seam and search direction, beyond which a job's word of near and far tells too
  // little: 60 deg, where a metre along the seam is half a metre along the search.
  double across_search = 60 * kDegree;
  // mm; from the seam, where a plate is straight again - bench.
  double straight_from = 4;
  // mm; a bead lies so near the seam, and stands so far before both plates - bench.
  double tack_reach = 8, tack_height = 1;
};
inline constexpr AnswerConstants kAnswer;

}  // namespace arcstart::seam_finding
