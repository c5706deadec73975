// What lies in a scene of the wild, in words by which its errors may be sorted.
#pragma once

#include <string>
#include <vector>

#include "services/cell_simulator/wild/wild_scene.hpp"
#include "services/cell_simulator/wild/wild_truth.hpp"
#include "tests/seam_finding/support/wild_scan.hpp"

namespace arcstart {

// Each once. The start's and the end's sight are those of the first seam.
std::vector<std::string> tags_of(const cell_simulator::WildScene& scene,
                                 const cell_simulator::WildTruth& truth,
                                 const std::vector<seam_finding::synthetic::WildSeamSight>& sights);

// "outside", "hidden", "bounded", "crossed"
const char* name_of(seam_finding::synthetic::WildSight::Kind kind);

}  // namespace arcstart
