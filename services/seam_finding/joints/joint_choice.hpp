// Which of the candidates is the joint, and whether it may be answered.
#pragma once

#include <optional>
#include <vector>

#include "services/seam_finding/background/scan_view.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/seam.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

struct Choice {
  std::optional<Joint> joint;                         // the answer's
  Reason reason;                                      // why there is none
  bool ambiguous = false;                             // for several are as good
  std::vector<SeamResult::Alternative> alternatives;  // best first
};

// Of the candidates, best first, one for each seam; those that may be the joint are measured again
// beside it. The best is chosen, unless something speaks against it or another comes too near.
Choice choose_joint(const ScanView& scan, std::vector<Joint> candidates, const Scales& scales,
                    const SeamFindingSettings& settings);

}  // namespace arcstart::seam_finding
