// The figures of the seam in closed form: the mean errors of 20 scans of each joint are held
// against the table of services/seam_finding/BENCHMARK.md, so that a loss of accuracy shows here
// and not only when somebody runs the bench.
#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include "common/geometry.hpp"
#include "paths.hpp"
#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/background/surface_background.hpp"
#include "services/seam_finding/find_seam.hpp"
#include "services/seam_finding/referee/ruling.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

namespace {

constexpr int kSeeds = 20;  // the table's
constexpr double kAllowed =
    1.5;  // times the table; what spoils a figure makes it several times as large

// Means over the answered scans; mm, direction in deg, gap -1 where none is there to be measured.
struct Figures {
  int answered = 0;
  double start = 0, across = 0, direction = 0, end = 0, gap = -1;
};

std::string as_row(const std::string& name, const Figures& figures) {
  return fmt::format("| {} | {} | {:.3f} | {:.4f} | {:.4f} | {:.3f} | {} |", name, figures.answered,
                     figures.start, figures.across, figures.direction, figures.end,
                     figures.gap < 0 ? "" : fmt::format("{:.4f}", figures.gap));
}

// The row of this name in the document's section "Held by the tests".
Figures tabled(const std::string& name) {
  std::ifstream document(ARCSTART_SOURCE "/services/seam_finding/BENCHMARK.md");
  bool there = false;
  for (std::string line; std::getline(document, line);) {
    if (line.rfind("## ", 0) == 0) there = line == "## Held by the tests";
    if (!there || line.rfind("| " + name + " |", 0) != 0) continue;
    for (char& character : line) character = character == '|' ? ' ' : character;
    Figures figures;
    std::istringstream numbers(line.substr(name.size() + 2));
    numbers >> figures.answered >> figures.start >> figures.across >> figures.direction >>
        figures.end;
    REQUIRE(numbers);
    if (!(numbers >> figures.gap)) figures.gap = -1;
    return figures;
  }
  FAIL("BENCHMARK.md has no such row: " << name);
  return {};
}

// A scan of the empty cell, and the background that refers to it.
struct EmptyCell {
  ScanCloud cloud;
  SurfaceBackground background;
  EmptyCell(const ScanChoice& scan, std::uint64_t seed)
      : cloud(make_scan(make_scene({.workpiece = false}, seed), scan, 1000 + seed).cloud),
        background(cloud, SeamFindingSettings{}.background_distance()) {}
};

// The same for all joints.
const Background& background(const ScanChoice& scan, std::uint64_t seed) {
  static std::map<std::pair<bool, std::uint64_t>, std::unique_ptr<EmptyCell>> cells;
  auto& cell = cells[{scan.bends, seed}];
  if (!cell) cell = std::make_unique<EmptyCell>(scan, seed);
  return cell->background;
}

struct Row {
  const char* name;
  SceneChoice scene;
  const char* asked;
  bool bends;  // kept, as reconstruction keeps them; gaps are measured by them
};

// What the gap is said to be where it is known; a groove's is its width at the top.
double true_gap(const Row& row, const Scene& scene) {
  if (row.scene.root_gap > 0) return row.scene.root_gap;
  if (row.scene.joint == "butt") return 1;
  if (row.scene.joint != "v") return -1;
  return 2 + 2 * (2 * scene.boxes[0].half_size.z()) * std::tan(30 * kDegree);
}

Figures measured(const Row& row) {
  Figures sum;
  double gaps = 0;
  int with_gap = 0;
  const ScanChoice scan{.bends = row.bends};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = make_scene(row.scene, seed);
    const ScanCloud work = make_scan(scene, scan, seed).cloud;
    SeamFindingSettings settings;
    settings.joint_type = row.asked;
    SeamResult result = find_seam(work, background(scan, seed), settings, seed);
    rule(examine(work, result), result);
    if (result.verdict != SeamResult::Verdict::kFound) {
      UNSCOPED_INFO(row.name << " seed " << seed << ": " << in_words(result.reason));
      continue;
    }
    ++sum.answered;
    CHECK(result.joint_type == scene.joint_type);
    const Eigen::Vector3d direction = (scene.end - scene.start).normalized();
    const Eigen::Vector3d error = result.start - scene.start;
    sum.start += error.norm();
    sum.across += (error - error.dot(direction) * direction).norm();
    sum.direction += angle_between(result.direction, direction) / kDegree;
    sum.end += (result.end - scene.end).norm();
    if (const double gap = true_gap(row, scene); gap >= 0 && result.gap >= 0) {
      ++with_gap;
      gaps += std::abs(result.gap - gap);
    }
  }
  for (double* value : {&sum.start, &sum.across, &sum.direction, &sum.end})
    *value /= std::max(1, sum.answered);
  // A mean over a few would say nothing of the others.
  if (2 * with_gap > sum.answered) sum.gap = gaps / with_gap;
  return sum;
}

}  // namespace

TEST_CASE("each joint's mean errors are those of the table", "[figures]") {
  const Row row = GENERATE(
      Row{"tee", {}, "tee", false}, Row{"tee, gap of 1.5 mm", {.root_gap = 1.5}, "tee", true},
      Row{"inside corner", {.joint = "inside_corner"}, "corner", false},
      Row{"outside corner", {.joint = "outside_corner"}, "outside_corner", false},
      Row{"lap", {.joint = "lap"}, "any", true},
      Row{"lap, gap of 1.5 mm", {.joint = "lap", .root_gap = 1.5}, "lap", true},
      Row{"butt, gap of 1 mm", {.joint = "butt"}, "any", true},
      Row{"V-groove", {.joint = "v"}, "any", true});
  const Figures found = measured(row);
  INFO(as_row(row.name, found));
  const Figures table = tabled(row.name);
  CHECK(found.answered >= table.answered);
  CHECK(found.start <= kAllowed * table.start);
  CHECK(found.across <= kAllowed * table.across);
  CHECK(found.direction <= kAllowed * table.direction);
  CHECK(found.end <= kAllowed * table.end);
  CHECK((found.gap >= 0) == (table.gap >= 0));
  if (table.gap >= 0) CHECK(found.gap <= kAllowed * table.gap);
}
