#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "services/reconstruction/reconstruction_settings.hpp"
#include "tests/bench/seam/rendered_answer.hpp"
#include "tests/bench/seam/seam_row.hpp"
#include "tests/bench/seam/seam_scenes.hpp"

namespace arcstart {

using namespace cell_simulator;
using namespace reconstruction;
namespace {

SimulatedScanSettings without_tool() {
  SimulatedScanSettings settings;
  settings.scene.tool_lying_about = false;
  return settings;
}

// The root gap, by station and its mean along the seam. A fifth of the seeds.
void bench_root_gaps(int seeds, const SeedsOfRow& wanted, nlohmann::json& json) {
  fmt::print(
      "\nRoot gap, rendered: mean along the seam and its deviation from the truth, mean and "
      "largest\n"
      "of all seeds; of single stations root mean square, share within two of the deviations "
      "given,\n"
      "and share that is measured; mm\n");
  struct Kind {
    std::string joint;
    double angle_deg;
  };
  for (const auto& [joint, angle] : {Kind{"tee", 90}, {"tee", 75}, {"tee", 105}, {"lap", 90}})
    for (const double gap : {0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0}) {
      SimulatedScanSettings settings = without_tool();
      settings.scene.joint = joint;
      settings.scene.joint_angle_deg = angle;
      settings.scene.root_gap_mm = gap;
      const double truth = gap * std::sin(angle * std::numbers::pi / 180);
      double sum = 0, off = 0, most = 0, squared = 0;
      int answered = 0, stations = 0, measured = 0, within = 0;
      for (int seed = wanted.first; seed < wanted.first + seeds; ++seed) {
        const seam_t seam = answer_rendered(settings, joint, static_cast<std::uint64_t>(seed)).seam;
        if (seam.verdict != seam_t::FOUND) continue;
        for (const seam_station_t& station : seam.stations) {
          ++stations;
          if (station.gap < 0) continue;
          ++measured;
          squared += (station.gap - truth) * (station.gap - truth);
          within += std::abs(station.gap - truth) < 2 * station.gap_deviation;
        }
        if (seam.gap < 0) continue;
        ++answered;
        sum += seam.gap;
        off += std::abs(seam.gap - truth);
        most = std::max(most, std::abs(seam.gap - truth));
      }
      const std::string name = fmt::format("root_gap.{}{:.0f}.{:.1f}", joint, angle, gap);
      const double n = std::max(1, answered), places = std::max(1, measured);
      fmt::print("{:18} {:3} of {:3} | mean {:.2f}, off {:.3f} {:.3f} | {:.3f}, {:.2f}, {:.2f}\n",
                 name, answered, seeds, sum / n, off / n, most, std::sqrt(squared / places),
                 within / places, measured / std::max(1.0, double(stations)));
      json[name + ".n"] = answered;
      json[name + ".off_mean_mm"] = off / n;
      json[name + ".off_max_mm"] = most;
      json[name + ".station_rms_mm"] = std::sqrt(squared / places);
      json[name + ".within_2sigma"] = within / places;
      json[name + ".measured"] = measured / std::max(1.0, double(stations));
    }
}

}  // namespace

void bench_rendered(int seeds, const SeedsOfRow& wanted, nlohmann::json& json) {
  fmt::print(
      "\nRendered images, 1600 x 1200, 50 mm/s, 14 frames/s, M = {}, true calibration. Seeds 1 to "
      "n; "
      "mm and deg\n",
      reconstruction::ReconstructionSettings{}.keep_every);
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
  cell_simulator::SensorSettings& glare = row("glare").sensor;
  glare.arc_grey = 400, glare.spatter_streaks = 25, glare.glowing_drops = 14;
  row("lean20").sensor.lean_deg = 20;
  row("box_on_base").scene.box_on_base = true;
  row("corner").scene.joint = "outside_corner";
  row("lap").scene.joint = "lap";
  SimulatedScanSettings& butt = row("butt");
  butt.scene.joint = "butt", butt.scene.root_gap_mm = 1;
  SimulatedScanSettings& v = row("v");
  v.scene.joint = std::string("v"), v.scene.root_gap_mm = 2;
  const std::string tee = "tee";
  // An outside corner has to be asked for.
  const std::map<std::string, std::string> asked{
      {"corner", "outside_corner"}, {"lap", "any"}, {"butt", "any"}, {"v", "any"}};
  for (const auto& [name, settings] : rows) {
    if (!wanted.makes(name)) continue;
    SeamRow figures(name + ".img");
    const auto other = asked.find(name);
    const std::string& joint = other == asked.end() ? tee : other->second;
    const int count = name == "tool" ? 2 * seeds : seeds;
    for (int seed = wanted.first; seed < wanted.first + count; ++seed) {
      const RenderedAnswer outcome =
          answer_rendered(settings, joint, static_cast<std::uint64_t>(seed));
      figures.add(seed, outcome.seam, outcome.truth, 0.15);
    }
    figures.finish(json);
  }
  if (wanted.makes("root_gap")) bench_root_gaps((seeds + 4) / 5, wanted, json);
}

}  // namespace arcstart
