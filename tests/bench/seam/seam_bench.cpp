// bench_seam: how right, how sure and how fast the seam is found. Every seed counts.
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <fstream>

#include "common/options.hpp"
#include "tests/bench/seam/seam_scenes.hpp"
#include "tests/bench/seam/wild/wild_bench.hpp"

int main(int argc, char** argv) {
  arcstart::Program options(
      "Errors, deviations and time of the seam over seeds of simulated scans");
  std::string json_path;
  int rendered = 25, profiles = 100, backgrounds = 5;
  int first = 1;
  std::string row;
  bool no_speed = false, wild = false, no_referee = false, falsified = false, pairs = false;
  constexpr int scenes_a_pair = 20;
  double minutes = 0;
  std::string scene;
  options.option("--json", json_path, "Where the figures go, flat JSON");
  options.option("--seeds", rendered, "Rendered scans a row, twice as many with a tool")
      .show_default();
  options.option("--profile-seeds", profiles, "Scans a row and noise that need no images")
      .show_default();
  options.option("--background-seeds", backgrounds, "Pairs of scans a row of the background")
      .show_default();
  options.option("--first-seed", first, "Of each row; those from 1 on are reported").show_default();
  options.option("--row", row, "Only the rows of this name, as in the table before the dot");
  options.flag("--no-speed", no_speed, "Leave the times out");
  options.flag("--wild", wild, "Scenes of the wild alone: rows JOINT.wild and JOINT.wild.img");
  options.flag("--no-referee", no_referee,
               "Their answers as they were found, before the referee; not of rendered images");
  options.flag("--falsified", falsified,
               "Of scenes of the wild: right answers made wrong on purpose, before the referee");
  options.flag("--pairs", pairs,
               "Of scenes of the wild: each joint asked of those of each other joint");
  options.option("--hunt", minutes,
                 "Draw scenes of the wild for so many minutes; the worst go to build/bench/hunt");
  options.option("--scene", scene, "Answer such a scene again").existing_file();
  if (const auto code = options.parse(argc, argv)) return *code;
  spdlog::set_level(spdlog::level::err);  // the tables alone
  nlohmann::json json;
  const arcstart::SeedsOfRow wanted{row, first};
  if (wild || falsified || pairs || minutes > 0 || !scene.empty()) {
    const arcstart::WildChoice scenes{profiles, rendered, wanted, !no_referee};
    if (!scene.empty()) arcstart::show_scene(scene);
    if (wild && !pairs && profiles > 0) arcstart::bench_wild(scenes, json);
    if (wild && !pairs && rendered > 0 && !no_referee) arcstart::bench_rendered_wild(scenes, json);
    if (falsified) arcstart::bench_falsified(scenes, json);
    if (pairs) arcstart::bench_pairs(scenes, scenes_a_pair, json);
    if (minutes > 0) arcstart::hunt(scenes, minutes, json);
    rendered = profiles = backgrounds = 0;
    no_speed = true;
  }
  if (rendered > 0) arcstart::bench_rendered(rendered, wanted, json);
  if (profiles > 0) arcstart::bench_profiles(profiles, wanted, json);
  if (backgrounds > 0) arcstart::bench_background(backgrounds, json);
  if (!no_speed) arcstart::bench_speed(json);
  if (!json_path.empty() && !(std::ofstream(json_path) << json.dump(2) << '\n')) {
    fmt::print(stderr, "bench_seam: {} cannot be written\n", json_path);
    return 1;
  }
  return 0;
}
