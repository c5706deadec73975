// The scenes of the table of seam errors: rendered as images, and as profiles with noise.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace arcstart {

// Which of the table is made.
struct SeedsOfRow {
  std::string row;  // of this name alone; empty: all
  int first = 1;    // seed

  bool makes(const std::string& name) const { return row.empty() || row == name; }
};

// Images of the simulated cell through extraction, reconstruction and seam finding as they ship.
// seeds: of each row; the row with a tool has twice as many.
void bench_rendered(int seeds, const SeedsOfRow& wanted, nlohmann::json& json);

// Profiles in closed form, noise of 0.1 and 0.3 mm along the laser's beam, through seam finding.
void bench_profiles(int seeds, const SeedsOfRow& wanted, nlohmann::json& json);

// What of the table is left and what of the workpiece is lost, by the default rule and the paper's.
void bench_background(int seeds, nlohmann::json& json);

// Time of a whole batch, beside the paper's chain in PCL.
void bench_speed(nlohmann::json& json);

}  // namespace arcstart
