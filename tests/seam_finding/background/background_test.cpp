#include "services/seam_finding/background/background.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "services/seam_finding/background/surface_background.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/paper/find_seam_as_in_the_paper.hpp"
#include "tests/seam_finding/support/pcl_judge.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

namespace {

struct Shares {
  double leak = 0;  // of the table's points, not taken for background
  double lost = 0;  // of the boxes' points, taken for background
};

Shares shares(const SyntheticScan& scan, const Background& background) {
  int table = 0, leaked = 0, boxes = 0, lost = 0;
  for (std::size_t i = 0; i < scan.truth.size(); ++i) {
    const bool taken = background.contains(scan.cloud.points[i]);
    if (scan.truth[i] == Truth::kTable) ++table, leaked += !taken;
    if (scan.truth[i] == Truth::kBox) ++boxes, lost += taken;
  }
  return {static_cast<double>(leaked) / table, static_cast<double>(lost) / std::max(1, boxes)};
}

// Both scans with the trigger's phase of their own seed.
struct Pair {
  SyntheticScan empty, work;
};
Pair scan_pair(const ScanChoice& of_empty, const ScanChoice& of_work, std::uint64_t seed) {
  const Scene scene = make_scene({.tool = true}, seed);
  Scene cell = scene;
  cell.boxes.clear();
  return {make_scan(cell, of_empty, 1000 + seed), make_scan(scene, of_work, seed)};
}

void check_surface_rule(int seeds) {
  // Thinning M, way between stripes at 14 frames a second: 50, 10 and 25 mm/s.
  const auto [downsample, pitch] = GENERATE(table<int, double>(
      {{1, 3.6}, {5, 3.6}, {15, 3.6}, {20, 3.6}, {15, 0.72}, {5, 0.72}, {15, 1.8}, {20, 1.8}}));
  ScanChoice choice;
  choice.downsample = downsample;
  choice.pitch = pitch;
  double leak = 0, lost = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Pair scans = scan_pair(choice, choice, seed);
    const Shares found = shares(scans.work, SurfaceBackground(scans.empty.cloud, 1.5));
    leak += found.leak / seeds;
    lost += found.lost / seeds;
  }
  INFO("M " << downsample << ", stripes " << pitch << " mm apart: leak " << 100 * leak
            << " %, lost " << 100 * lost << " %");
  CHECK(leak <= 0.01);
  CHECK(lost <= 0.015);
}

}  // namespace

TEST_CASE("surface rule: table left and workpiece lost, whatever thinning, speed and phase",
          "[figures]") {
  check_surface_rule(2);
}

TEST_CASE("surface rule: the same with more seeds", "[figures][long]") { check_surface_rule(8); }

TEST_CASE("surface rule: background and work scanned at different speeds") {
  ScanChoice slow, fast;
  slow.pitch = 0.72;
  for (const auto& [a, b] : {std::pair{slow, fast}, std::pair{fast, slow}}) {
    const Pair scans = scan_pair(a, b, 3);
    const Shares found = shares(scans.work, SurfaceBackground(scans.empty.cloud, 1.5));
    CHECK(found.leak <= 0.01);
    CHECK(found.lost <= 0.015);
  }
}

TEST_CASE("the paper's rule leaks the table between stripes 3.6 mm apart, and holds at 0.7 mm") {
  ScanChoice choice;
  const Pair coarse = scan_pair(choice, choice, 2);
  const Shares far = shares(coarse.work, NeighbourBackground(coarse.empty.cloud, 3, 1.5));
  CHECK(far.leak > 0.6);
  choice.pitch = 0.72;
  choice.downsample = 5;
  const Pair fine = scan_pair(choice, choice, 2);
  const Shares near = shares(fine.work, NeighbourBackground(fine.empty.cloud, 3, 1.5));
  CHECK(near.leak < 0.02);
  CHECK(near.lost < 0.02);
}

TEST_CASE("the paper's rule is that of a search through all points") {
  const Pair scans = scan_pair({}, {}, 5);
  for (const auto& [k, distance] : {std::pair{1, 1.0}, std::pair{3, 1.5}, std::pair{5, 6.0}}) {
    const NeighbourBackground background(scans.empty.cloud, k, distance);
    int differ = 0;
    for (int i = 0; i < scans.work.cloud.size(); i += 7) {
      const Eigen::Vector3d& point = scans.work.cloud.points[i];
      int near = 0;
      bool close_call = false;
      for (const auto& other : scans.empty.cloud.points) {
        near += (other - point).norm() < distance;
        close_call |= std::abs((other - point).norm() - distance) < 1e-3;  // PCL reckons in float
      }
      differ += !close_call && background.contains(point) != (near >= k);
    }
    CHECK(differ == 0);
  }
}

TEST_CASE("the paper's rule is PCL's distance") {
  const Pair scans = scan_pair({}, {}, 6);
  const auto judged = pcl_judge::kth_distance(scans.empty.cloud.points, scans.work.cloud.points, 3);
  const NeighbourBackground background(scans.empty.cloud, 3, 1.5);
  for (std::size_t i = 0; i < judged.size(); i += 3)
    if (std::abs(judged[i] - 1.5) > 1e-3)
      CHECK(background.contains(scans.work.cloud.points[i]) == (judged[i] < 1.5));
}

TEST_CASE("where the background scan did not look nothing is background") {
  const Pair scans = scan_pair({}, {}, 7);
  const SurfaceBackground background(scans.empty.cloud, 1.5);
  CHECK(background.contains({50, 20, 0}));
  CHECK_FALSE(background.contains({50, 20, 4}));
  CHECK_FALSE(background.contains({50, 20, -4}));
  CHECK_FALSE(background.contains({300, 20, 0}));
  CHECK_FALSE(background.contains({50, 500, 0}));
}

TEST_CASE("a step in the background is followed on both of its levels") {
  std::vector<Eigen::Vector3d> points;
  for (double x = 0; x < 100; x += 3.6)
    for (double y = 0; y < 100; y += 1.9) points.emplace_back(x, y, y < 50 ? 0 : 12);
  const ScanCloud cloud = unorganised_cloud(points);
  const SurfaceBackground background(cloud, 1.5);
  for (double x = 10; x < 90; x += 1.7)
    for (double y = 10; y < 90; y += 1.3) {
      if (std::abs(y - 50) < 2) continue;
      CHECK(background.contains({x, y, y < 50 ? 0.3 : 12.3}));
      CHECK_FALSE(background.contains({x, y, y < 50 ? 5.0 : 17.0}));
    }
}

TEST_CASE("a background of one stripe, or of none, is no surface and breaks nothing") {
  std::vector<Eigen::Vector3d> line;
  for (double y = 0; y < 50; y += 0.5) line.emplace_back(0, y, 0);
  const ScanCloud one = unorganised_cloud(line);
  const SurfaceBackground background(one, 1.5);
  CHECK(background.contains({0.2, 10, 0.1}));
  CHECK_FALSE(background.contains({0, 10, 9}));
  const ScanCloud none;
  CHECK_FALSE(SurfaceBackground(none, 1.5).contains({0, 0, 0}));
  CHECK_FALSE(NeighbourBackground(none, 3, 1.5).contains({0, 0, 0}));
}
