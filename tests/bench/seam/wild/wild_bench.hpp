// Scenes of the wild: scripts/bench seam --wild.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/bench/seam/seam_scenes.hpp"

namespace arcstart {

struct WildChoice {
  int profile_seeds = 100;  // scenes a joint, in closed form
  SeedsOfRow wanted;        // row: a joint of the wild
  bool referee = true;      // false: the rows are of answers as they were found
};

// Rows JOINT.wild: closed form through seam finding.
void bench_wild(const WildChoice& choice, nlohmann::json& json);

}  // namespace arcstart
