// What lies there is not what is asked for, or only looks like it.
#include <catch2/catch.hpp>
#include <cmath>

#include "common/geometry.hpp"
#include "tests/bench/seam/wild/judgement.hpp"
#include "tests/bench/seam/wild/wild_case.hpp"

using namespace arcstart;
using cell_simulator::WildScene;
using cell_simulator::WildSolid;
using cell_simulator::WildWork;

namespace {

WildScene scene_of(const WildWork& work, const std::string& asked) {
  WildScene scene;
  scene.asked = asked;
  scene.works = {work};
  scene.scan.begin_mm = -100, scene.scan.end_mm = 100;
  return scene;
}

// 140 x 90 mm, 10 mm thick, its top 10 mm over the table.
WildWork lone_plate() {
  WildWork work;
  work.first.thickness_mm = 10, work.first.behind_mm = 40;
  work.first.begin.at_mm = -70, work.first.end.at_mm = 70;
  work.second_missing = true;
  return work;
}

// On z, turned about the vertical.
WildSolid block(double length, double width, double height, const Eigen::Vector3d& foot,
                double turned_deg) {
  WildSolid solid;
  solid.size_mm = {length, width, height};
  solid.position_mm = {foot.x(), foot.y(), foot.z() + height / 2};
  const double half = turned_deg * kDegree / 2;
  solid.quaternion = {std::cos(half), 0, 0, std::sin(half)};
  return solid;
}

WildWork corner_of_plates(double yaw_deg) {
  WildWork work;
  work.joint = "outside_corner";
  work.first.thickness_mm = work.second.thickness_mm = 8;
  work.yaw_deg = yaw_deg;
  return work;
}

}  // namespace

TEST_CASE("a block on a plate is no upright where its foot is shorter than a seam") {
  for (const double length : {25.0, 60.0}) {
    INFO(length << " mm");
    WildScene scene = scene_of(lone_plate(), "tee");
    scene.solids = {block(length, 20, 30, {950, 5, 10}, 10)};
    const seam_t seam = WildCase(scene).answer(true);
    if (length < 30) {
      CHECK(seam.verdict == seam_t::REFUSED);
      CHECK(seam.refusal == seam_t::SEAM_TOO_SHORT);
    } else {
      // By what is seen of it, it is one.
      CHECK(seam.verdict == seam_t::FOUND);
    }
  }
}

TEST_CASE("the sides of a groove are no tee, whatever their angle") {
  WildWork work;
  work.joint = "v";
  work.first.thickness_mm = work.second.thickness_mm = 14;
  work.groove_deg = 85;
  const seam_t tee = WildCase(scene_of(work, "tee")).answer(true);
  INFO(tee.reason);
  CHECK(tee.verdict == seam_t::REFUSED);
  CHECK(tee.refusal == seam_t::GROOVE_NOT_WANTED);
  const WildCase groove(scene_of(work, "v"));
  CHECK(judge(groove.answer(true), groove.truth()).right);
}

TEST_CASE("the round edge of a hollow section is no outside corner of two plates") {
  WildWork work = lone_plate();
  work.first.section = "hollow";
  work.first.thickness_mm = 4, work.first.depth_mm = 45, work.first.corner_radius_mm = 6;
  const seam_t round = WildCase(scene_of(work, "outside_corner")).answer(true);
  INFO(round.reason);
  CHECK(round.verdict == seam_t::REFUSED);
  CHECK(round.refusal == seam_t::CORNER_ROUND);
}

TEST_CASE("the edge of a solid block is no outside corner of two plates") {
  WildScene scene = scene_of({}, "outside_corner");
  scene.works.clear();
  // The smaller one's end is nowhere farther from both sides than a thick plate's cut is wide.
  const bool small = GENERATE(false, true);
  scene.solids = {small ? block(45, 26, 29, {950, 80, 0}, -18)
                        : block(70, 45, 45, {950, 80, 0}, -18)};
  const seam_t edge = WildCase(scene).answer(true);
  INFO(edge.reason);
  CHECK(edge.verdict == seam_t::REFUSED);
  CHECK(edge.refusal == seam_t::EDGE_OF_BLOCK);

  const WildCase corner(scene_of(corner_of_plates(-18), "outside_corner"));
  const seam_t plates = corner.answer(true);
  INFO(plates.reason);
  CHECK(judge(plates, corner.truth()).right);
}

TEST_CASE("plates that meet at their inner edges are an outside corner, a block on one is none") {
  WildWork work = corner_of_plates(10);
  work.first.thickness_mm = 12;
  WildScene scene = scene_of(work, "outside_corner");
  SECTION("open") {
    scene.works[0].corner = "open";
    const WildCase open(scene);
    const seam_t seam = open.answer(true);  // a notch is not round
    INFO(seam.reason);
    REQUIRE(seam.verdict == seam_t::FOUND);
    const WildJudgement judgement = judge(seam, open.truth());
    CHECK(judgement.right);
    CHECK(std::abs(judgement.start.across) < 0.1);
    CHECK(std::abs(judgement.start.height) < 0.1);
  }
  // With the standing plate its top and its side are as an open corner's faces; but the corner
  // itself lies between.
  SECTION("a block beside the corner") {
    const auto start = WildCase(scene).truth().seams[0].start.point;
    const Eigen::Vector3d beside(0, 22, 0);
    scene.solids = {block(60, 30, 12, Eigen::Vector3d(950, 0, start.z()) + beside, 10)};
    const WildCase corner(scene);
    const seam_t seam = corner.answer(false);
    INFO(seam.reason);
    CHECK(seam.verdict == seam_t::FOUND);
    CHECK(judge(seam, corner.truth()).right);
  }
}

// The line's floor is a block between two plates, a little lower than they are.
TEST_CASE("a butt joint that may be a line milled in one plate says so") {
  WildWork work;
  work.joint = "butt";
  work.first.thickness_mm = work.second.thickness_mm = 10;
  work.gap_begin_mm = work.gap_end_mm = 1.4;
  WildScene scene = scene_of(work, "butt");
  const std::string words = "it may be a line in one plate";
  const seam_t through = WildCase(scene).answer(true);
  CHECK(through.verdict == seam_t::FOUND);
  CHECK_THAT(through.remark, !Catch::Matchers::Contains(words));
  // A backing 4 mm thick below plates of 6; and a line 0.8 mm deep.
  scene.solids = {block(100, 1.4, 4, {950, 0, 0}, 0)};
  CHECK_THAT(WildCase(scene).answer(true).remark, !Catch::Matchers::Contains(words));
  scene.solids = {block(100, 1.4, 9.2, {950, 0, 0}, 0)};
  CHECK_THAT(WildCase(scene).answer(true).remark, Catch::Matchers::Contains(words));
}
