#include <fmt/format.h>

#include <map>

#include "services/extraction/extraction_app.hpp"
#include "services/reconstruction/reconstruction_app.hpp"
#include "services/seam_finding/seam_finding_app.hpp"
#include "tests/bench/seam_row.hpp"
#include "tests/bench/seam_scenes.hpp"
#include "tests/bench/simulated_scan.hpp"

namespace arcstart {
namespace {

struct Outcome {
  seam_t seam{};
  truth_t truth{};
};

// How the pipeline is set for a row.
struct Asked {
  std::string joint_type = "tee";
  double keep_bend_px = 0;
};

Outcome run_seed(const SimulatedScanSettings& settings, const Asked& asked, std::uint64_t seed) {
  const auto bus = Bus::in_memory();
  const Instance instance;  // no state folder: nothing outlives the run
  ExtractionApp extraction(*bus, ExtractionSettings{}, instance);
  ReconstructionSettings reconstruction_settings;
  reconstruction_settings.keep_bend_px = asked.keep_bend_px;
  ReconstructionApp reconstruction(*bus, reconstruction_settings, instance);
  SeamFindingSettings seam_settings;
  seam_settings.joint_type = asked.joint_type;
  SeamFindingApp seam_finding(*bus, seam_settings, instance);
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

void bench_rendered(int seeds, const SeedsOfRow& wanted, nlohmann::json& json) {
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
  // As the images of an arc that extraction is measured with.
  SensorSettings& glare = row("glare").sensor;
  glare.arc_grey = 400, glare.spatter_streaks = 25, glare.glowing_drops = 14;
  row("lean20").sensor.lean_deg = 20;
  row("box_on_base").scene.box_on_base = true;
  row("corner").scene.joint = "outside_corner";
  row("lap").scene.joint = "lap";
  SimulatedScanSettings& butt = row("butt");
  butt.scene.joint = "butt", butt.scene.root_gap_mm = 1;
  SimulatedScanSettings& v = row("v");
  v.scene.joint = "v", v.scene.root_gap_mm = 2;
  // A gap of 1 mm is narrower than the M-th centre: the bends of the stripe are kept for it. An
  // outside corner has to be asked for.
  const std::map<std::string, Asked> asked{
      {"corner", {"outside_corner"}}, {"lap", {"any"}}, {"butt", {"any", 1}}, {"v", {"any"}}};
  for (const auto& [name, settings] : rows) {
    if (!wanted.makes(name)) continue;
    SeamRow figures(name + ".img");
    const int count = name == "tool" ? 2 * seeds : seeds;
    for (int seed = wanted.first; seed < wanted.first + count; ++seed) {
      const Outcome outcome = run_seed(settings, asked.contains(name) ? asked.at(name) : Asked{},
                                       static_cast<std::uint64_t>(seed));
      figures.add(seed, outcome.seam, outcome.truth, 0.15);
    }
    figures.finish(json);
  }
}

}  // namespace arcstart
