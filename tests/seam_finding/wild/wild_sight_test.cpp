#include <catch2/catch.hpp>

#include "tests/seam_finding/support/wild_scan.hpp"
#include "tests/seam_finding/wild/plain_scene.hpp"

namespace arcstart::seam_finding::synthetic {
namespace {

using namespace cell_simulator;
using Kind = WildSight::Kind;

WildSeamSight sight_of(const WildScene& scene) {
  const WildScan scan = wild_scan(scene, SceneKind::workpiece);
  REQUIRE(scan.sights.size() == 1);
  return scan.sights[0];
}

}  // namespace

TEST_CASE("Stripes cross an upright's end at a slant") {
  const WildSeamSight sight = sight_of(plain_tee());
  CHECK(sight.start.kind() == Kind::kCrossed);
  CHECK(sight.end.kind() == Kind::kCrossed);
  // The sheet leans by the 22 deg of its axis along the search: over the upright's 40 mm it moves
  // on by some 13 to 16 mm, three to five stripes.
  CHECK(sight.start.crossings >= 3);
  CHECK(sight.start.crossings <= 5);
}

TEST_CASE("An end along the stripes is crossed by none, though it is in view") {
  WildScene scene = plain_tee();
  int least = 100;
  bool in_view = true;
  for (double turn = -30; turn <= 30; turn += 1) {
    scene.works[0].second.begin.turn_deg = turn;
    const WildSight start = sight_of(scene).start;
    in_view = in_view && start.in_view;
    least = std::min(least, start.crossings);
  }
  CHECK(in_view);
  CHECK(least <= 1);
}

TEST_CASE("An end behind something is hidden, the other is not") {
  WildScene scene = plain_tee();
  WildSolid wall;
  wall.size_mm = {60, 5, 100};
  wall.position_mm = {900, -20, 60};
  scene.solids = {wall};
  const WildSeamSight sight = sight_of(scene);
  CHECK(sight.start.kind() == Kind::kHidden);
  CHECK(sight.end.kind() == Kind::kCrossed);
}

TEST_CASE("A seam that begins before the scan starts outside of it") {
  WildScene scene = plain_tee();
  scene.scan.begin_mm = -30;
  scene.scan.end_mm = 20;
  const WildSeamSight sight = sight_of(scene);
  CHECK(sight.start.kind() == Kind::kOutside);
  CHECK(sight.end.kind() == Kind::kOutside);
}

TEST_CASE("The plate that ends first is the one whose edge must be crossed") {
  WildScene scene = plain_tee();
  scene.works[0].first.begin.at_mm = -45;  // 5 mm after the upright
  const WildSight later = sight_of(scene).start;
  CHECK(later.in_view);
  CHECK(later.crossings >= 2);
  // Stripes run over the base plate at a slant of their own; an edge along them is not crossed,
  // however the upright's is.
  int least = 100;
  for (double turn = -30; turn <= 30; turn += 1) {
    scene.works[0].first.begin.turn_deg = turn;
    least = std::min(least, sight_of(scene).start.crossings);
  }
  CHECK(least <= 1);
}

}  // namespace arcstart::seam_finding::synthetic
