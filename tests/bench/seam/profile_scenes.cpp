#include <fmt/format.h>

#include "services/seam_finding/background/surface_background.hpp"
#include "services/seam_finding/find_seam.hpp"
#include "services/seam_finding/paper/find_seam_as_in_the_paper.hpp"
#include "services/seam_finding/referee/ruling.hpp"
#include "services/seam_finding/scan/scan_answer.hpp"
#include "services/seam_finding/scan/seam_message.hpp"
#include "tests/bench/seam/seam_row.hpp"
#include "tests/bench/seam/seam_scenes.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

namespace arcstart {

using namespace seam_finding;
namespace {

using synthetic::ScanChoice;
using synthetic::SceneChoice;

std::optional<truth_t> truth_of(const synthetic::Scene& scene) {
  if (scene.start == scene.end) return std::nullopt;
  truth_t truth{};
  truth.joint_type = scene.joint_type;
  const Eigen::Vector3d direction = (scene.end - scene.start).normalized();
  std::copy(scene.start.begin(), scene.start.end(), truth.start);
  std::copy(scene.end.begin(), scene.end.end(), truth.end);
  std::copy(direction.begin(), direction.end(), truth.direction);
  return truth;
}

seam_t answer(const synthetic::Scene& scene, const ScanChoice& choice,
              const std::string& joint_type, int seed) {
  synthetic::Scene cell = scene;
  cell.boxes.clear();
  const auto number = static_cast<std::uint64_t>(seed);
  const seam_finding::ScanCloud empty = make_scan(cell, choice, 1000 + number).cloud;
  const seam_finding::ScanCloud work = make_scan(scene, choice, number).cloud;
  seam_finding::SeamFindingSettings settings;
  settings.joint_type = joint_type;
  const seam_finding::SurfaceBackground background(empty, settings.background_distance());
  seam_t seam = seam_finding::empty_seam();
  SeamResult result = seam_finding::find_seam(work, background, settings, number);
  rule(examine(work, result), result);
  seam_finding::fill_in(seam, result);
  return seam;
}

}  // namespace

void bench_profiles(int seeds, const SeedsOfRow& wanted, nlohmann::json& json) {
  fmt::print("\nProfiles with noise of 0.1 (s01) and 0.3 mm (s03). Seeds 1 to n; mm and deg\n");
  print_row_header();
  struct Row {
    const char* name;
    SceneChoice scene;
    ScanChoice scan;
    bool long_scan = false;          // takes so long that a tenth of the seeds must do
    const char* joint_type = "tee";  // asked for
  };
  const SceneChoice tool{.tool = true};
  const Row rows[] = {
      {"none", {}, {}},
      {"tool", tool, {}},
      {"big_box", {.big_box = true}, {}},
      {"box_on_base", {.box_on_base = true}, {}},
      {"long_base", {.tool = true, .base_overhang = 10}, {}},
      {"short_base", {.tool = true, .base_overhang = -10}, {}},
      {"tee75", {.tilt_deg = 75}, {}},
      {"tee105", {.tilt_deg = 105}, {}},
      {"m1", tool, {.downsample = 1}, true},
      {"m5", tool, {.downsample = 5}},
      {"m20", tool, {.downsample = 20}},
      {"v10", tool, {.pitch = 0.72}, true},
      {"v100", tool, {.pitch = 7.2}},
      {"lap", {.joint = "lap"}, {.bends = true}, false, "any"},
      {"corner", {.joint = "outside_corner"}, {}, false, "outside_corner"},
      {"butt", {.joint = "butt"}, {.bends = true}, false, "any"},
      {"v", {.joint = "v"}, {.bends = true}, false, "any"},
      {"empty", {.workpiece = false}, {}},
      {"lone_plate", {.lone_plate = true}, {}},
      {"two_boxes", {.workpiece = false, .tool = true, .big_box = true}, {}},
  };
  for (const Row& row : rows)
    for (const double noise : {0.1, 0.3}) {
      if (!wanted.makes(row.name)) break;
      SeamRow figures(fmt::format("{}.{}", row.name, noise < 0.2 ? "s01" : "s03"));
      ScanChoice choice = row.scan;
      choice.noise = noise;
      const int count = row.long_scan ? (seeds + 9) / 10 : seeds;
      for (int seed = wanted.first; seed < wanted.first + count; ++seed) {
        const synthetic::Scene scene =
            synthetic::make_scene(row.scene, static_cast<std::uint64_t>(seed));
        const bool hidden = row.scene.box_on_base && !synthetic::start_in_sight(scene, choice);
        figures.add(seed, answer(scene, choice, row.joint_type, seed), truth_of(scene), 1, hidden);
      }
      figures.finish(json);
    }
}

void bench_background(int seeds, nlohmann::json& json) {
  fmt::print(
      "\nBackground: share of the table left, and of the workpiece lost, %; beside it the paper's "
      "rule\n");
  fmt::print("{:>3} {:>5} {:>8} {:>8} | {:>8} {:>8}\n", "M", "mm/s", "left", "lost", "left",
             "lost");
  for (const auto& [speed, pitch] : {std::pair(50, 3.6), std::pair(10, 0.72)})
    for (const int downsample : {1, 5, 15}) {
      ScanChoice choice;
      choice.downsample = downsample, choice.pitch = pitch;
      double counts[2][2] = {}, all[2] = {};  // rule; table left, workpiece lost
      for (int seed = 1; seed <= seeds; ++seed) {
        const auto number = static_cast<std::uint64_t>(seed);
        const synthetic::Scene scene = synthetic::make_scene({.tool = true}, number);
        synthetic::Scene cell = scene;
        cell.boxes.clear();
        const seam_finding::ScanCloud empty = make_scan(cell, choice, 1000 + number).cloud;
        const auto work = make_scan(scene, choice, number);
        const seam_finding::SeamFindingSettings settings;
        const seam_finding::SurfaceBackground surface(empty, settings.background_distance());
        seam_finding::SeamFindingSettings as_in_the_paper;
        as_in_the_paper.background_rule = seam_finding::BackgroundRule::kNeighbours;
        const seam_finding::NeighbourBackground paper(empty, as_in_the_paper.background_neighbours,
                                                      as_in_the_paper.background_distance());
        const seam_finding::Background* rules[2] = {&surface, &paper};
        for (int i = 0; i < work.cloud.size(); ++i) {
          if (work.truth[i] == synthetic::Truth::kOutlier) continue;
          const bool table = work.truth[i] == synthetic::Truth::kTable;
          ++all[table ? 0 : 1];
          for (int rule = 0; rule < 2; ++rule)
            counts[rule][table ? 0 : 1] += rules[rule]->contains(work.cloud.points[i]) != table;
        }
      }
      const std::string name = fmt::format("background.{}.{}", downsample, speed);
      json[name + ".n"] = seeds;
      json[name + ".leak"] = counts[0][0] / all[0];
      json[name + ".lost"] = counts[0][1] / all[1];
      json[name + ".paper_leak"] = counts[1][0] / all[0];
      json[name + ".paper_lost"] = counts[1][1] / all[1];
      fmt::print("{:>3} {:>5} {:>8.2f} {:>8.2f} | {:>8.2f} {:>8.2f}\n", downsample, speed,
                 100 * counts[0][0] / all[0], 100 * counts[0][1] / all[1],
                 100 * counts[1][0] / all[0], 100 * counts[1][1] / all[1]);
      std::fflush(stdout);
    }
}

}  // namespace arcstart
