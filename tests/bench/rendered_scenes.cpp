#include <fmt/format.h>

#include "services/extraction/extraction_app.hpp"
#include "services/reconstruction/reconstruction_app.hpp"
#include "services/seam_finding/seam_finding_app.hpp"
#include "tests/bench/seam_row.hpp"
#include "tests/bench/seam_scenes.hpp"
#include "tests/bench/simulated_scan.hpp"

namespace arcstart {
namespace {

struct Outcome {
  seam_t seam;
  truth_t truth;
};

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
  // Losses spoil the workpiece scan alone: a background is scanned again until it is whole.
  SimulatedScanSettings whole = settings;
  whole.frames_lost_share = whole.positions_lost_share = 0;
  SimulatedScan scan(*bus, whole, seed);
  scan.run(SceneKind::background);
  scan.set_losses(settings.frames_lost_share, settings.positions_lost_share);
  scan.run(SceneKind::workpiece);
  outcome.truth = scan.truth();
  return outcome;
}

SimulatedScanSettings without_tool() {
  SimulatedScanSettings settings;
  settings.scene.tool_lying_about = false;
  return settings;
}

}  // namespace

void bench_rendered(int seeds, nlohmann::json& json) {
  fmt::print(
      "\nRendered images, 1600 x 1200, 50 mm/s, 14 frames/s, M = {}, true calibration. Seeds 1 to "
      "n; "
      "mm and deg\n",
      ReconstructionSettings{}.keep_every);
  print_row_header();
  std::vector<std::pair<std::string, SimulatedScanSettings>> rows{{"tool", {}},
                                                                  {"none", without_tool()}};
  const auto row = [&](const std::string& name) -> SimulatedScanSettings& {
    return rows.emplace_back(name, without_tool()).second;
  };
  rows.emplace_back("tool_block", SimulatedScanSettings{}).second.scene.box_beside = true;
  row("gap1").scene.root_gap_mm = 1;
  SimulatedScanSettings& lost = row("lost");
  lost.frames_lost_share = 0.1, lost.positions_lost_share = 0.3;
  row("tee75").scene.joint_angle_deg = 75;
  row("tee105").scene.joint_angle_deg = 105;
  row("lean20").sensor.lean_deg = 20;
  row("box_on_base").scene.box_on_base = true;
  for (const auto& [name, settings] : rows) {
    SeamRow figures(name + ".img");
    const int count = name == "tool" ? 2 * seeds : seeds;
    for (int seed = 1; seed <= count; ++seed) {
      const Outcome outcome = run_seed(settings, static_cast<std::uint64_t>(seed));
      figures.add(seed, outcome.seam, outcome.truth, 0.15);
    }
    figures.finish(json);
  }
}

}  // namespace arcstart
