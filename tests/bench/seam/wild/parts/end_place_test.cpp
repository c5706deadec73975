// Where a seam starts, in scenes whose plates' ends are easily taken for others.
#include <catch2/catch.hpp>

#include "paths.hpp"
#include "tests/bench/seam/wild/judgement.hpp"
#include "tests/bench/seam/wild/scene_file.hpp"
#include "tests/bench/seam/wild/wild_case.hpp"

using namespace arcstart;
using cell_simulator::WildScene;

namespace {

// A base plate that reaches 20 mm beyond an upright of 100 mm.
WildScene bare(const char* joint) {
  WildScene scene = read_scene(ARCSTART_SOURCE "/tests/bench/seam/wild/plain_tee.json");
  scene.solids.clear();
  scene.works[0].joint = scene.asked = joint;
  return scene;
}

// Before the referee, which improves no answer.
PlaceError start_of(const WildScene& scene) {
  const WildCase wild(scene);
  const seam_t seam = wild.answer(false);
  INFO("refused with " << seam.refusal << ": " << seam.reason);
  REQUIRE(seam.verdict == seam_t::FOUND);
  const WildJudgement judgement = judge(seam, wild.truth());
  REQUIRE(judgement.right);
  REQUIRE(seam.start_visibility == seam_t::SEEN);
  return judgement.start;
}

}  // namespace

TEST_CASE("an edge that is turned away from the seam is found, whichever way it is turned") {
  WildScene scene = bare("tee");
  scene.works[0].second.begin.turn_deg = GENERATE(-28.0, 15.0, 28.0);
  INFO("turned by " << scene.works[0].second.begin.turn_deg << " deg");
  const PlaceError start = start_of(scene);
  CHECK(std::abs(start.along) < 0.25);
  CHECK(start.deviation < 0.3);  // without what stripes show on their way to the seam 1.1
}

TEST_CASE("an upright that stands off ends where its foot does, however its edge is turned") {
  WildScene scene = bare("tee");
  scene.works[0].second.begin.turn_deg = GENERATE(-25.0, 25.0);
  scene.works[0].gap_begin_mm = scene.works[0].gap_end_mm = 2;
  INFO("turned by " << scene.works[0].second.begin.turn_deg << " deg");
  const PlaceError start = start_of(scene);
  CHECK(std::abs(start.along) < 0.3);  // 0.4 and more on the edge's line to the seam
  CHECK(start.deviation < 0.5);
}

TEST_CASE("a lap of bent plates starts square below the upper plate's end") {
  WildScene scene = bare("lap");
  cell_simulator::WildWork& work = scene.works[0];
  work.second.thickness_mm = 12;
  work.first.behind_mm = 60;
  work.bow_mm = GENERATE(-1.0, 1.0);
  INFO("bent by " << work.bow_mm << " mm in 100");
  CHECK(std::abs(start_of(scene).along) < 0.2);  // 0.4 plumb below it
}

TEST_CASE("a seam starts before what lies across it, however far before") {
  WildScene scene = bare(GENERATE("tee", "v"));
  cell_simulator::WildWork& work = scene.works[0];
  work.second.begin.at_mm = -70, work.second.end.at_mm = 70;
  work.first.begin.at_mm = -80, work.first.end.at_mm = 80;
  scene.scan.begin_mm = -100, scene.scan.end_mm = 100;
  cell_simulator::WildSolid across;
  across.size_mm = {32, 50, 30};
  // On the upright's open side, or on both plates.
  across.position_mm = {924, work.joint == "v" ? 0.0 : -25.0, work.first.thickness_mm + 15};
  scene.solids = {across};
  INFO(work.joint);
  CHECK(std::abs(start_of(scene).along) < 0.2);
}

TEST_CASE(
    "a butt joint ends where a run-off tab begins, though its gap holds one point of a stripe") {
  WildScene scene = bare("butt");
  cell_simulator::WildWork& work = scene.works[0];
  work.first.behind_mm = 0;
  work.second.thickness_mm = work.first.thickness_mm;
  work.first.begin.at_mm = work.second.begin.at_mm;
  work.gap_begin_mm = work.gap_end_mm = GENERATE(1.5, 2.7);
  work.tabs = {{true, 20, 30, work.first.thickness_mm, 0}};
  INFO("gap of " << work.gap_begin_mm << " mm");
  CHECK(std::abs(start_of(scene).along) < 2);  // 20 at the tab's other end
}
