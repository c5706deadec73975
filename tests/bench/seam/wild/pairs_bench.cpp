#include <fmt/format.h>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "services/cell_simulator/wild/wild_build.hpp"
#include "tests/bench/seam/figures.hpp"
#include "tests/bench/seam/wild/judgement.hpp"
#include "tests/bench/seam/wild/wild_bench.hpp"
#include "tests/bench/seam/wild/wild_case.hpp"

namespace arcstart {

using cell_simulator::WildScene;
using cell_simulator::WildTruth;
namespace {

bool fillet(const std::string& joint) { return joint == "tee" || joint == "inside_corner"; }

// Of the next seed from this on whose scene has clutter in it, and none of the joint that is asked
// for; the seed goes on behind it.
WildCase next_case(const std::string& asked, const std::string& joint, int& seed) {
  for (;;) {
    WildScene scene = cell_simulator::draw_wild_scene(joint, static_cast<std::uint64_t>(seed++));
    scene.asked = asked;
    if (scene.solids.empty() || scene.works.empty()) continue;
    try {
      if (truth_of(scene).wrong) return WildCase(scene);
    } catch (const cell_simulator::SceneError&) {
      // Drawn beyond what can be built; the next one.
    }
  }
}

// The upper plate's cut stands on the lower plate: a fillet, though no scene of a lap says so.
bool at_a_laps_cut(const WildCase& wild, const seam_t& seam) {
  WildScene as_lap = wild.scene();
  as_lap.asked = "lap";
  WildTruth truth = truth_of(as_lap);
  return judge(seam, truth).right;
}

}  // namespace

void bench_pairs(const WildChoice& choice, int scenes, nlohmann::json& json) {
  fmt::print("\nWrong parts: a joint asked of scenes of another, {} each: how many were found\n",
             scenes);
  int all = 0, found_of_all = 0;
  for (const std::string asked : cell_simulator::wild_joints)
    for (const std::string joint : cell_simulator::wild_joints) {
      // Seen from inside, a corner is a tee.
      if (asked == joint || (fillet(asked) && fillet(joint)) || !choice.wanted.makes(asked))
        continue;
      int seed = choice.wanted.first, found = 0, allowed = 0;
      for (int i = 0; i < scenes; ++i) {
        const WildCase wild = next_case(asked, joint, seed);
        const seam_t seam = wild.answer(choice.referee);
        if (seam.verdict != seam_t::FOUND) continue;
        if (fillet(asked) && joint == "lap" && at_a_laps_cut(wild, seam)) {
          ++allowed;
          continue;
        }
        ++found;
        fmt::print("  {} asked of {} seed {}: {}\n", asked, joint, seed - 1,
                   judge(seam, wild.truth()).silent.at(0).text);
      }
      fmt::print("{:<15} of {:<15} found {:>3} of {:>3}{}\n", asked, joint, found, scenes,
                 allowed > 0 ? fmt::format(", and {} along the lap's cut", allowed) : "");
      std::fflush(stdout);
      json["wrong_part." + asked + "." + joint] = found;
      all += scenes, found_of_all += found;
    }
  fmt::print("wrong_part.found {} of {}\n", found_of_all, all);
  json["wrong_part.n"] = all;
  json["wrong_part.found"] = found_of_all;
}

}  // namespace arcstart
