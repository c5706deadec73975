#include "services/seam_finding/find_seam.hpp"

#include <fmt/core.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "common/geometry.hpp"
#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/background/surface_background.hpp"
#include "tests/draws.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

namespace {

// A quarter of them; all: [long].
int some(int seeds) { return test::draws(std::max(2, seeds / 4)); }

struct Case {
  Scene scene;
  SyntheticScan work;
  ScanCloud empty;
};

Case make_case(const SceneChoice& choice, const ScanChoice& scan, int seed) {
  Case made;
  made.scene = make_scene(choice, seed);
  Scene cell = made.scene;
  cell.boxes.clear();
  made.empty = make_scan(cell, scan, 1000 + seed).cloud;
  made.work = make_scan(made.scene, scan, seed);
  return made;
}

SeamResult find(const Case& made, int seed, const SeamFindingSettings& settings = {}) {
  const SurfaceBackground background(made.empty, settings.background_distance());
  return find_seam(made.work.cloud, background, settings, seed);
}

bool found(const SeamResult& result) { return result.verdict == SeamResult::Verdict::kFound; }

struct Table {
  int found = 0, ambiguous = 0, refused = 0, wrong = 0;
  double start_sum = 0, start_max = 0, lateral_max = 0, direction_max = 0;  // mm, deg
  int covered = 0;  // starts within two of the standard deviations given
  double start_mean() const { return start_sum / std::max(1, found); }
};

// Errors as they are defined for the product: p - s along the true direction and across it.
void count(Table& table, const SeamResult& result, const Scene& scene) {
  if (!found(result)) {
    ++(result.verdict == SeamResult::Verdict::kAmbiguous ? table.ambiguous : table.refused);
    UNSCOPED_INFO(in_words(result.reason));
    return;
  }
  ++table.found;
  const Eigen::Vector3d direction = (scene.end - scene.start).normalized();
  const Eigen::Vector3d error = result.start - scene.start;
  const double lateral = (error - error.dot(direction) * direction).norm();
  const double turn = angle_between(result.direction, direction) * 180 / M_PI;
  table.wrong += lateral > 5 || turn > 5 || result.joint_type != "tee" ||
                 (result.start - scene.end).norm() < error.norm();
  if (result.accuracy) {
    const double variance = direction.dot(result.accuracy->start * direction);
    table.covered += std::pow(error.dot(direction), 2) <= 4 * variance;
  }
  table.start_sum += error.norm();
  table.start_max = std::max(table.start_max, error.norm());
  table.lateral_max = std::max(table.lateral_max, lateral);
  table.direction_max = std::max(table.direction_max, turn);
}

Table run(const SceneChoice& choice, const ScanChoice& scan, int seeds,
          const SeamFindingSettings& settings = {}) {
  Table table;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Case made = make_case(choice, scan, seed);
    count(table, find(made, seed, settings), made.scene);
  }
  return table;
}

struct Row {
  const char* name;
  SceneChoice scene;
  ScanChoice scan;
  int seeds;
  double start_mean, start_max, lateral_max, direction_max;  // mm, deg
};

std::vector<Row> rows() {
  const SceneChoice none, tool{.tool = true};
  const ScanChoice usual, noisy{.noise = 0.3};
  return {
      {"no clutter", none, usual, 50, 0.15, 0.6, 0.05, 0.05},
      {"tool", tool, usual, 50, 0.15, 0.6, 0.05, 0.05},
      {"tool, noise 0.3 mm", tool, noisy, 50, 0.2, 0.6, 0.15, 0.12},
      {"box larger than the work", {.big_box = true}, usual, 50, 0.15, 0.6, 0.05, 0.06},
      {"box before the start", {.box_on_base = true}, usual, 100, 0.15, 0.8, 0.07, 0.06},
      {"base begins earlier", {.tool = true, .base_overhang = 10}, usual, 20, 0.3, 1, 0.05, 0.05},
      {"base begins later", {.tool = true, .base_overhang = -10}, usual, 20, 0.3, 2.2, 0.06, 0.06},
      {"75 deg", {.tilt_deg = 75}, usual, 20, 0.2, 0.8, 0.05, 0.05},
      {"105 deg", {.tilt_deg = 105}, usual, 20, 0.2, 0.8, 0.05, 0.05},
      {"M = 5", tool, {.downsample = 5}, 20, 0.15, 0.6, 0.05, 0.05},
      {"M = 20", tool, {.downsample = 20}, 20, 0.15, 0.6, 0.06, 0.05},
      {"M = 1", tool, {.downsample = 1}, 4, 0.2, 0.5, 0.05, 0.05},
      {"10 mm/s", tool, {.pitch = 0.72}, 6, 0.2, 0.7, 0.05, 0.05},
      {"100 mm/s", tool, {.pitch = 7.2}, 20, 0.9, 7.2, 0.1, 0.08},
      {"leaning 20 deg", none, {.lean_deg = 20}, 20, 0.6, 2.2, 0.05, 0.05},
  };
}

void check_rows(const std::function<int(int)>& seeds) {
  for (const Row& row : rows()) {
    const Table table = run(row.scene, row.scan, seeds(row.seeds));
    INFO(
        fmt::format("{}: {} found, {} ambiguous, {} refused, {} wrong; start {:.2f} mean {:.2f} "
                    "max, lateral {:.3f} mm, direction {:.4f} deg",
                    row.name, table.found, table.ambiguous, table.refused, table.wrong,
                    table.start_mean(), table.start_max, table.lateral_max, table.direction_max));
    CHECK(table.wrong == 0);
    CHECK(table.ambiguous + table.refused == 0);
    CHECK(10 * table.covered >= 9 * table.found - 10);  // one more in a row of few
    CHECK(table.start_mean() <= row.start_mean);
    CHECK(table.start_max <= row.start_max);
    CHECK(table.lateral_max <= row.lateral_max);
    CHECK(table.direction_max <= row.direction_max);
  }
}

}  // namespace

TEST_CASE("the seam is found in every scene, and never a wrong one") { check_rows(some); }

TEST_CASE("the same with every seed", "[figures][long]") {
  check_rows([](int seeds) { return seeds; });
}

TEST_CASE("where there is no joint none is found") {
  const auto [name, choice] = GENERATE(table<std::string, SceneChoice>({
      {"empty table", {.workpiece = false}},
      {"a lone plate", {.lone_plate = true}},
      {"a box and a tool", {.workpiece = false, .tool = true, .big_box = true}},
  }));
  const Table table = run(choice, {}, some(20));
  INFO(name);
  CHECK(table.refused == some(20));
}

TEST_CASE("the paper's ways are there to choose") {
  SECTION("the largest plane first: right without clutter, no answer beside a larger box") {
    SeamFindingSettings settings;
    settings.plane_rule = PlaneRule::kLargest;
    CHECK(run({}, {}, some(10), settings).found == some(10));
    CHECK(run({}, {}, some(10), settings).wrong == 0);
    CHECK(run({.big_box = true}, {}, some(10), settings).found == 0);
  }
  SECTION("centroid of the first points: it lies late, by its own nature") {
    SeamFindingSettings settings;
    settings.start_rule = StartRule::kCentroid;
    const Table table = run({.tool = true}, {}, some(20), settings);
    CHECK(table.wrong == 0);
    CHECK(table.start_mean() > run({.tool = true}, {}, some(20)).start_mean());
    CHECK(table.start_mean() < 6);
  }
}

TEST_CASE("normals point out of the metal, the angle is between the open sides") {
  for (const double tilt : {75.0, 90.0, 105.0}) {
    const Case made = make_case({.tilt_deg = tilt}, {}, 4);
    const SeamResult result = find(made, 4);
    REQUIRE(found(result));
    CHECK(result.angle * 180 / M_PI == Approx(tilt).margin(0.1));
    for (const auto& truth : made.scene.normals) {
      const double nearest = std::min(angle_between(result.normals[0], truth),
                                      angle_between(result.normals[1], truth));
      CHECK(nearest * 180 / M_PI < 0.1);
    }
    CHECK(std::abs(result.direction.dot(result.normals[0])) < 1e-9);
    CHECK(result.direction.norm() == Approx(1));
  }
}

TEST_CASE("what the background scan did not reach is no plate") {
  // The background scan ended early: most of the table under the work is not in it.
  const Case made = make_case({}, {}, 6);
  Scene cell = made.scene;
  cell.boxes.clear();
  ScanChoice half;
  half.to = 30;
  const ScanCloud background = make_scan(cell, half, 77).cloud;
  const SeamResult result = find_seam(made.work.cloud, SurfaceBackground(background, 1.5), {}, 6);
  Table table;
  count(table, result, made.scene);
  CHECK(table.wrong == 0);
}

TEST_CASE("a scan in which too little was seen is refused") {
  const Case made = make_case({}, {}, 8);
  const SurfaceBackground background(made.empty, 1.5);
  const auto with = [&](auto change) {
    ScanCloud cloud;
    const ScanCloud& whole = made.work.cloud;
    for (std::size_t k = 0; k < whole.stripes.size(); ++k) {
      const ScanStripe& stripe = whole.stripes[k];
      if (!change(stripe.tool_position.x())) {
        end_stripe(cloud, ScanStripe::Seen::kMissing);
        continue;
      }
      for (int i = stripe.first; i < stripe.first + stripe.count; ++i) {
        cloud.points.push_back(whole.points[i]);
        cloud.origins.push_back(whole.origins[i]);
      }
      end_stripe(cloud, stripe.seen, stripe.camera_centre, stripe.tool_position);
    }
    return find_seam(cloud, background, {}, 8);
  };
  // Whatever is cut away, an answer must not be wrong.
  Table table;
  for (int from = -30; from < 140; from += 10) {
    count(table, with([&](double x) { return x > from; }), made.scene);
    count(table, with([&](double x) { return x < from; }), made.scene);
    count(table, with([&](double x) { return x < from || x > from + 12; }), made.scene);
  }
  CHECK(table.wrong == 0);
  CHECK(table.start_max < 12);
  CHECK(table.refused > 10);
  CHECK(table.found > 20);
  const double start = made.scene.start.x();
  const SeamResult late = with([&](double x) { return x > start + 30; });
  CHECK(late.verdict == SeamResult::Verdict::kRefused);
  CHECK(late.reason.code == Reason::Code::kStartBeforeScan);
  const SeamResult gap = with([&](double x) { return x < start - 25 || x > start + 25; });
  CHECK(gap.verdict == SeamResult::Verdict::kRefused);
  CHECK(gap.reason.code == Reason::Code::kStartMissing);
  const SeamResult early = with([&](double x) { return x < start + 50; });
  REQUIRE(found(early));
  CHECK(early.end_visibility == EndVisibility::kOutside);
  CHECK_THAT(in_words(early.remarks), Catch::Contains("where the scan ends"));
}

TEST_CASE("two seams of like length are ambiguous, and both are listed") {
  // A second upright on the same base, parallel to the first and farther out.
  Scene scene = make_scene({}, 9);
  Box second = scene.boxes[1];
  second.T_base_box = second.T_base_box * Eigen::Translation3d(0, 32, 10 - second.half_size.z());
  second.half_size.z() = 10;  // so low that it leaves the base before the first in view
  scene.boxes.push_back(second);
  Scene cell = scene;
  cell.boxes.clear();
  const ScanCloud empty = make_scan(cell, {}, 1).cloud;
  const ScanCloud work = make_scan(scene, {}, 2).cloud;
  const SeamResult result = find_seam(work, SurfaceBackground(empty, 1.5), {}, 9);
  REQUIRE(result.verdict == SeamResult::Verdict::kAmbiguous);
  REQUIRE(result.alternatives.size() >= 2);
  CHECK(result.alternatives[0].score <= 1.5 * result.alternatives[1].score);
  CHECK(std::min((result.alternatives[0].start - scene.start).norm(),
                 (result.alternatives[1].start - scene.start).norm()) < 4);
}

TEST_CASE("the same scan gives the same answer, bit by bit") {
  const Case made = make_case({.tool = true, .big_box = true}, {}, 5);
  const SeamResult first = find(made, 123456789), second = find(made, 123456789);
  REQUIRE(found(first));
  CHECK(first.start == second.start);
  CHECK(first.end == second.end);
  CHECK(first.direction == second.direction);
  CHECK(first.plates == second.plates);
  CHECK(first.alternatives.size() == second.alternatives.size());
  // Another seed draws other hypotheses; the plates are the same within the noise.
  const SeamResult other = find(made, 987654321);
  REQUIRE(found(other));
  CHECK((other.start - first.start).norm() < 0.05);
}
