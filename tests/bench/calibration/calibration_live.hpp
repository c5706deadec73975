// The calibration through the real processes of the simulated cell.
#pragma once

#include <nlohmann/json.hpp>

namespace arcstart::test {

// `arcstart calibrate --live` in a cell of its own for each of the seeds 1 to `seeds`, the robot
// wrong by 0.1 mm and 0.01 deg in every pose; end to end against the true sensor. False where the
// cell did not come up or calibrate. Needs a network of its own.
bool bench_live(int seeds, nlohmann::json& json);

}  // namespace arcstart::test
