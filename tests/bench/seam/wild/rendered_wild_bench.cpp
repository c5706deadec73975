#include <fmt/format.h>

#include "services/cell_simulator/wild/wild_build.hpp"
#include "tests/bench/seam/rendered_answer.hpp"
#include "tests/bench/seam/wild/judgement.hpp"
#include "tests/bench/seam/wild/wild_bench.hpp"
#include "tests/bench/seam/wild/wild_case.hpp"
#include "tests/bench/seam/wild/wild_row.hpp"

namespace arcstart {

using cell_simulator::SceneKind;
using cell_simulator::WildScene;

void bench_rendered_wild(const WildChoice& choice, nlohmann::json& json) {
  fmt::print("\nScenes of the wild in rendered images through the whole pipeline; mm and deg\n");
  print_wild_header();
  for (const std::string joint : cell_simulator::wild_joints) {
    if (!choice.wanted.makes(joint)) continue;
    WildRow row(joint + ".wild.img");
    const auto use = [&](const WildScene& scene, int seed) {
      const cell_simulator::WildTruth truth = truth_of(scene);
      SimulatedScanSettings settings;
      settings.wild = scene;
      const seam_t seam =
          answer_rendered(settings, joint_setting(scene.asked), static_cast<std::uint64_t>(seed))
              .seam;
      // What is in view is the same of the scan in closed form: its stripes lie in the same places.
      const auto sights = seam_finding::synthetic::wild_scan(scene, SceneKind::workpiece).sights;
      row.add(facts_of(scene, truth, sights, seed), seam,
              judge(seam, truth, scene.scan.robot_wave_mm));
    };
    for_each_scene(joint, choice.wanted.first, choice.rendered_seeds, use);
    row.finish(json);
  }
}

}  // namespace arcstart
