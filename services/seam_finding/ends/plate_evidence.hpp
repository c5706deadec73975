// What each stripe says of where one plate of a joint ends along the seam.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "services/seam_finding/ends/edge_crossing.hpp"
#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"
#include "services/seam_finding/visibility/plate_stripes.hpp"

namespace arcstart::seam_finding {

// On the plate's plane: outward along the seam, toward the end that is looked for, and away from
// it; mm.
struct PlacePart {
  double out = 0, away = 0;
};
// A stretch of a stripe, by its two ends.
using Stretch = std::array<PlacePart, 2>;

struct StripeEvidence {
  std::vector<Stretch> on;          // the plate is seen there
  std::vector<Stretch> off;         // what lies behind it is: there is none
  std::vector<EdgeCrossing> edges;  // where it leaves the plate, two at most; along: outward, too
  // Where it shows no plate beside the seam: so far from it that others do.
  std::optional<PlacePart> absent;
  bool covered = false;  // something stands before both plates where it crosses the seam
};

// Toward the begin and toward the end. `stations` say whether the plate is there at the seam; their
// places are along the line of `stripes`. In a cloud without stripes they alone tell.
std::array<std::vector<StripeEvidence>, 2> plate_evidence(const ScanCloud& cloud,
                                                          const PlateStripes& stripes,
                                                          const Stations& stations, int plate,
                                                          const Scales& scales,
                                                          const SeamFindingSettings& settings);

// The same, away from a seam that lies so far away from the line; mm.
std::vector<StripeEvidence> beside_seam(std::vector<StripeEvidence> evidence, double seam_away);

}  // namespace arcstart::seam_finding
