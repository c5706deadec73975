// Where a plate, and the seam between two, begins or ends.
#pragma once

namespace arcstart::seam_finding {

enum class SeamSide { kBegin = -1, kEnd = 1 };

enum class EndVisibility { kNotDetermined, kSeen, kHidden, kOutside };

struct SeamEnd {
  double along = 0;     // along the seam's line; mm
  double variance = 0;  // of it; mm2
  EndVisibility visibility = EndVisibility::kNotDetermined;
  bool by_edges = false;  // else known to half the distance of two stripes
  // Where else it may lie, along the line, mm, and how probable that is; 0: nowhere.
  double second = 0, second_weight = 0;
};

}  // namespace arcstart::seam_finding
