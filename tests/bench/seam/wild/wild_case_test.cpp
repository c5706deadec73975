#include "tests/bench/seam/wild/wild_case.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "paths.hpp"
#include "tests/bench/seam/wild/falsified.hpp"
#include "tests/bench/seam/wild/judgement.hpp"
#include "tests/bench/seam/wild/scene_file.hpp"
#include "tests/bench/seam/wild/scene_tags.hpp"

using namespace arcstart;

namespace {

WildCase plain_tee() {
  return WildCase(read_scene(ARCSTART_SOURCE "/tests/bench/seam/wild/plain_tee.json"));
}

}  // namespace

TEST_CASE("a scene of the wild from a file is scanned and answered") {
  const WildCase wild = plain_tee();
  REQUIRE(wild.truth().seams.size() == 1);
  // As the file has it: the upright from -50 to 50 about the work's middle, on a base of 10 mm.
  const cell_simulator::WildSeam& seam = wild.truth().seams[0];
  CHECK((seam.start.point - Eigen::Vector3d(900, 0, 10)).norm() < 1e-6);
  CHECK((seam.end.point - Eigen::Vector3d(1000, 0, 10)).norm() < 1e-6);
  for (const bool referee : {false, true}) {
    const seam_t answer = wild.answer(referee);
    INFO(answer.reason);
    REQUIRE(answer.verdict == seam_t::FOUND);
    const WildJudgement judgement = judge(answer, wild.truth());
    CHECK(judgement.right);
    CHECK(judgement.silent.empty());
    CHECK(std::hypot(answer.start[0] - 900, answer.start[1], answer.start[2] - 10) < 0.5);
    CHECK(std::hypot(answer.end[0] - 1000, answer.end[1], answer.end[2] - 10) < 0.5);
    CHECK((answer.stripes_checked > 0) == referee);
  }
  // The sheet leans, so that stripes climb the upright at a slant and leave it over its ends.
  const auto tags = tags_of(wild.scene(), wild.truth(), wild.sights());
  CHECK(tags == std::vector<std::string>{"start_crossed", "end_crossed", "block"});
}

TEST_CASE("what is asked for is what is sought") {
  cell_simulator::WildScene scene =
      read_scene(ARCSTART_SOURCE "/tests/bench/seam/wild/plain_tee.json");
  scene.asked = "butt";
  const WildCase wild(scene);
  CHECK(wild.truth().wrong);
  CHECK(wild.answer(true).verdict != seam_t::FOUND);
  CHECK(joint_setting("inside_corner") == "corner");
}

TEST_CASE("answers are made wrong by as much as is said") {
  const WildCase wild = plain_tee();
  REQUIRE(wild.found().verdict == seam_finding::SeamResult::Verdict::kFound);
  constexpr double spacing = 3.6;
  int ends = 0, turned = 0, swapped = 0;
  for (const Falsified& one : falsified(wild.found(), wild.cloud(), spacing, 1)) {
    INFO(one.kind << ": " << one.text);
    const auto &is = one.seam, &was = wild.found();
    if (one.end != ClaimedEnd::kNone) {
      ++ends;
      const bool start = one.end == ClaimedEnd::kStart;
      CHECK(std::abs(one.off_mm) >= 1.5 * spacing);
      CHECK((is.end - is.start).norm() - (was.end - was.start).norm() == Approx(one.off_mm));
      CHECK((start ? is.end - was.end : is.start - was.start).norm() == 0);
    } else if (one.kind == "turned") {
      ++turned;
      const int plate = is.normals[0] == was.normals[0] ? 1 : 0;
      CHECK(is.normals[1 - plate] == was.normals[1 - plate]);
      CHECK(std::acos(is.normals[plate].dot(was.normals[plate])) == Approx(M_PI / 180));
      const Plane& face = is.faces[plate].plane;
      CHECK(std::abs(face.normal.dot(was.start) + face.offset) < 0.1);
    } else {
      ++swapped;
      CHECK(is.normals[0] == was.normals[1]);
    }
  }
  CHECK(ends == 8);
  CHECK(turned == 4);
  CHECK(swapped == 1);
}
