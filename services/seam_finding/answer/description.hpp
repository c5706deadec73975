// What is said of a seam: the answer.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/model/seam_end.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// What was measured of the joint that was chosen.
struct Findings {
  std::array<SeamEnd, 2> ends;  // start and end, along the joint's line
  std::optional<SeamAccuracy> accuracy;
  std::vector<SeamMeasurement> stations;  // along counts on the joint's line
  bool with_stripes = true;               // else how well the ends are seen is not said
};

// A found seam.
SeamResult describe(Joint joint, Findings findings, const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
