#include "tests/bench/seam/wild/wild_bench.hpp"

#include <fmt/format.h>

#include <optional>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "services/cell_simulator/wild/wild_scene.hpp"
#include "tests/bench/seam/wild/judgement.hpp"
#include "tests/bench/seam/wild/scene_tags.hpp"
#include "tests/bench/seam/wild/wild_case.hpp"
#include "tests/bench/seam/wild/wild_row.hpp"

namespace arcstart {
namespace {

WildFacts facts_of(const WildCase& wild, int seed) {
  return {seed, wild.truth().wrong, wild.scene().scan.pitch_mm, wild.sights(),
          tags_of(wild.scene(), wild.truth(), wild.sights())};
}

// A scene that cannot be is told, and is none of the row.
std::optional<WildCase> draw(const std::string& joint, int seed) {
  try {
    return WildCase(cell_simulator::draw_wild_scene(joint, static_cast<std::uint64_t>(seed)));
  } catch (const cell_simulator::SceneError& error) {
    fmt::print("  {} seed {}: no scene: {}\n", joint, seed, error.what());
    return std::nullopt;
  }
}

}  // namespace

void bench_wild(const WildChoice& choice, nlohmann::json& json) {
  fmt::print("\nScenes of the wild in closed form{}; mm and deg\n",
             choice.referee ? "" : ", without the referee");
  print_wild_header();
  WildTagTable table;
  for (const std::string joint : cell_simulator::wild_joints) {
    if (!choice.wanted.makes(joint)) continue;
    WildRow row(joint + ".wild");
    for (int i = 0; i < choice.profile_seeds; ++i) {
      const int seed = choice.wanted.first + i;
      const auto wild = draw(joint, seed);
      if (!wild) continue;
      const WildFacts facts = facts_of(*wild, seed);
      const seam_t before = wild->answer(false), after = wild->answer(true);
      const WildJudgement judged[2] = {judge(before, wild->truth()), judge(after, wild->truth())};
      row.add(facts, choice.referee ? after : before, judged[choice.referee]);
      table.add(facts, joint, judged[0], judged[1]);
    }
    row.finish(json);
  }
  table.print();
}

}  // namespace arcstart
