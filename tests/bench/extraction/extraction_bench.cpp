// bench_extraction: accuracy, identity and time of the stripe extraction, beside what OpenCV alone
// does.
#include "tests/bench/extraction/extraction_bench.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <opencv2/core.hpp>

#include "common/options.hpp"

int main(int argc, char** argv) {
  using namespace arcstart;
  Program options("Stripe extraction on rendered scenes of 1600 x 1200: accuracy, identity, time");
  std::string json_path;
  int seeds = 8, first_seed = 1, rounds = 30;
  std::vector<std::string> parts;
  options.option("--json", json_path, "Where the figures go, flat JSON");
  options.option("--seeds", seeds, "Of each scene, 1 to N, none left out").show_default();
  options
      .option("--first-seed", first_seed,
              "Of the rows texture, neighbour, print and mixed_width, which take N from it on")
      .show_default();
  options.option("--rounds", rounds, "Of the timing").show_default();
  options
      .option("--part", parts,
              "accuracy, disturbances, noise, real, identity, speed, texture, neighbour, print or "
              "mixed_width; all by default")
      .one_of({"accuracy", "disturbances", "noise", "real", "identity", "speed", "texture",
               "neighbour", "print", "mixed_width"});
  std::string pictures;
  options.option("--pictures", pictures, "Draw the scenes into this folder, measure nothing")
      .existing_folder();
  if (const auto code = options.parse(argc, argv)) return *code;
  cv::setNumThreads(1);
  if (!pictures.empty()) {
    arcstart::draw_scenes(pictures);
    return 0;
  }
  const auto wanted = [&](const std::string& part) {
    return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  nlohmann::json json;
  if (wanted("speed")) bench_speed(rounds, json);
  if (wanted("identity")) bench_identity(seeds, json);
  if (wanted("noise")) bench_white_noise(seeds, json);
  if (wanted("real")) bench_real_images(json);
  if (wanted("disturbances")) bench_disturbances(seeds, json);
  if (wanted("accuracy")) bench_accuracy(seeds, json);
  for (const extraction::SteelSceneKind kind : extraction::kAllSteelScenes)
    if (wanted(extraction::name_of(kind))) bench_steel(kind, first_seed, seeds, json);
  if (!json_path.empty() && !(std::ofstream(json_path) << json.dump(2) << '\n')) {
    fmt::print(stderr, "bench_extraction: {} cannot be written\n", json_path);
    return 1;
  }
  return 0;
}
