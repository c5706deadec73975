// bench_seam: the whole pipeline on rendered scans of the simulated cell, every seed told.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "services/command_line/seam_error.hpp"
#include "services/extraction/extraction_app.hpp"
#include "services/reconstruction/reconstruction_app.hpp"
#include "services/seam_finding/seam_finding_app.hpp"
#include "tests/bench/simulated_scan.hpp"

using namespace arcstart;

namespace {

struct Outcome {
  seam_t seam;
  truth_t truth;
};

// Background and workpiece scan of one seed, through extraction, reconstruction and seam finding as
// they ship.
Outcome run_seed(const SimulatedScanSettings& settings, std::uint64_t seed) {
  const auto bus = Bus::in_memory();
  const Instance instance;  // no state folder: nothing outlives the run
  ExtractionApp extraction(*bus, ExtractionSettings{}, instance);
  ReconstructionApp reconstruction(*bus, ReconstructionSettings{}, instance);
  SeamFindingApp seam_finding(*bus, SeamFindingSettings{}, instance);
  Outcome outcome{};
  outcome.seam.verdict = seam_t::REFUSED;
  outcome.seam.reason = "no answer came";
  bus->subscribe<seam_t>("LASER0_SEAM", Queue::measurements(),
                         [&](const seam_t& seam) { outcome.seam = seam; });
  SimulatedScan scan(*bus, settings, seed);
  scan.run(SceneKind::background);
  scan.run(SceneKind::workpiece);
  outcome.truth = scan.truth();
  return outcome;
}

void run_row(const std::string& row, const SimulatedScanSettings& settings, int seeds,
             nlohmann::json& json) {
  int wrong = 0, refused = 0, found = 0;
  double lateral_max = 0, direction_max = 0, start_sum = 0, start_max = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Outcome outcome = run_seed(settings, static_cast<std::uint64_t>(seed));
    fmt::print("{:<12} {:>4}  ", row, seed);
    if (outcome.seam.verdict != seam_t::FOUND) {
      ++refused;
      fmt::print("{}: {}\n", outcome.seam.verdict == seam_t::AMBIGUOUS ? "ambiguous" : "refused",
                 outcome.seam.reason);
      continue;
    }
    const SeamError error = seam_error(outcome.seam, outcome.truth);
    ++found;
    wrong += error.wrong;
    lateral_max = std::max(lateral_max, error.lateral_mm);
    direction_max = std::max(direction_max, error.direction_deg);
    start_sum += error.start_mm;
    start_max = std::max(start_max, error.start_mm);
    fmt::print("{:>8.3f} {:>9.3f} {:>9.4f} {:>10.4f}{}\n", error.start_mm, error.along_mm,
               error.lateral_mm, error.direction_deg, error.wrong ? "  WRONG" : "");
    std::fflush(stdout);
  }
  fmt::print(
      "{:<12} {} seeds: {} wrong, {} refused; start mean {:.3f} max {:.3f} mm, lateral max {:.4f} "
      "mm, "
      "direction max {:.4f} deg\n\n",
      row, seeds, wrong, refused, found ? start_sum / found : 0, start_max, lateral_max,
      direction_max);
  json[row + ".n"] = seeds;
  json[row + ".wrong"] = wrong;
  json[row + ".refused"] = refused;
  json[row + ".lateral_max_mm"] = lateral_max;
  json[row + ".direction_max_deg"] = direction_max;
  json[row + ".start_mean_mm"] = found ? start_sum / found : 0;
  json[row + ".start_max_mm"] = start_max;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options(
      "Accuracy of the seam over seeds of the simulated cell, in process, images rendered");
  std::string json_path;
  int seeds = 20;
  options.add_option("--json", json_path, "Where the figures go, flat JSON");
  options.add_option("--seeds", seeds, "Seeds 1 to N, none left out")->capture_default_str();
  CLI11_PARSE(options, argc, argv);
  spdlog::set_level(spdlog::level::warn);  // the table alone
  nlohmann::json json;
  fmt::print(
      "Tee with a tool lying about, 50 mm/s, 14 frames/s, M = {}, true calibration, 1600 x 1200\n",
      ReconstructionSettings{}.keep_every);
  fmt::print("{:<12} {:>4}  {:>8} {:>9} {:>9} {:>10}\n", "row", "seed", "start mm", "along mm",
             "lateral", "direction");
  run_row("tool.img", {}, seeds, json);
  if (!json_path.empty() && !(std::ofstream(json_path) << json.dump(2) << '\n')) {
    fmt::print(stderr, "bench_seam: {} cannot be written\n", json_path);
    return 1;
  }
  return 0;
}
