// A set with one mistake in it: found, named, left out, and what it costs.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/bench/calibration/simulated_plate.hpp"

namespace arcstart::test {

using namespace calibration;
using namespace cell_simulator;

// The three mistakes that a set must bear, each in one of its poses. What comes, over what the same
// poses without a mistake give: RMS over the seeds.
struct Mistake {
  const char* name;
  double squares = 0, clean = 0;
  int named = 0, seeds = 0, others = 0;
};

// Each mistake by itself in one pose of a set whose robot errs by 0.1 mm and 0.01 deg.
void run_mistakes(cell_simulator::PlateImages& images, const cell_simulator::PrintedPlate& printed,
                  const std::vector<RigidTransform>& poses,
                  const std::vector<calibration::View>& true_views, std::uint64_t seed,
                  std::vector<Mistake>& mistakes);

void report(const std::vector<Mistake>& mistakes, nlohmann::json& json);

}  // namespace arcstart::test
