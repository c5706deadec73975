#include "tests/bench/seam/wild/wild_bench.hpp"

#include <fmt/format.h>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "tests/bench/seam/wild/judgement.hpp"
#include "tests/bench/seam/wild/scene_tags.hpp"
#include "tests/bench/seam/wild/wild_case.hpp"
#include "tests/bench/seam/wild/wild_row.hpp"

namespace arcstart {
void for_each_scene(const std::string& joint, int first, int count,
                    const std::function<void(const cell_simulator::WildScene&, int seed)>& use) {
  for (int seed = first; seed < first + count; ++seed) try {
      use(cell_simulator::draw_wild_scene(joint, static_cast<std::uint64_t>(seed)), seed);
    } catch (const cell_simulator::SceneError& error) {
      fmt::print("  {} seed {}: no scene: {}\n", joint, seed, error.what());
    }
}

void bench_wild(const WildChoice& choice, nlohmann::json& json) {
  fmt::print("\nScenes of the wild in closed form{}; mm and deg\n",
             choice.referee ? "" : ", without the referee");
  print_wild_header();
  WildTagTable table;
  for (const std::string joint : cell_simulator::wild_joints) {
    if (!choice.wanted.makes(joint)) continue;
    WildRow row(joint + ".wild");
    for_each_scene(joint, choice.wanted.first, choice.profile_seeds,
                   [&](const cell_simulator::WildScene& scene, int seed) {
                     const WildCase wild(scene);
                     const WildFacts facts = facts_of(scene, wild.truth(), wild.sights(), seed);
                     const seam_t before = wild.answer(false), after = wild.answer(true);
                     const WildJudgement judged[2] = {
                         judge(before, wild.truth(), scene.scan.robot_wave_mm),
                         judge(after, wild.truth(), scene.scan.robot_wave_mm)};
                     row.add(facts, choice.referee ? after : before, judged[choice.referee]);
                     table.add(facts, joint, judged[0], judged[1]);
                   });
    row.finish(json);
  }
  table.print();
}

}  // namespace arcstart
