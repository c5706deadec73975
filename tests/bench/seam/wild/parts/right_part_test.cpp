// What is asked for lies there, in a shape or a place that is easily refused.
#include <catch2/catch.hpp>
#include <cmath>

#include "common/geometry.hpp"
#include "paths.hpp"
#include "tests/bench/seam/wild/judgement.hpp"
#include "tests/bench/seam/wild/scene_file.hpp"
#include "tests/bench/seam/wild/wild_case.hpp"

using namespace arcstart;
using cell_simulator::WildScene;

namespace {

WildScene bare_tee() {
  WildScene scene = read_scene(ARCSTART_SOURCE "/tests/bench/seam/wild/plain_tee.json");
  scene.solids.clear();
  return scene;
}

// Found, right, and nothing of it wrong and sure.
void check_answered(const WildScene& scene) {
  const WildCase wild(scene);
  const seam_t seam = wild.answer(true);
  INFO("refused with " << seam.refusal << ": " << seam.reason);
  REQUIRE(seam.verdict == seam_t::FOUND);
  const WildJudgement judgement = judge(seam, wild.truth());
  CHECK(judgement.right);
  CHECK(judgement.silent.empty());
}

}  // namespace

// EN 1993-1-8, 4.3.2.1: fillet welds join faces that meet under 60 to 120 deg.
TEST_CASE("fillets of 60 to 120 deg are found") {
  WildScene scene = bare_tee();
  scene.works[0].joint = scene.asked = GENERATE("tee", "inside_corner");
  scene.works[0].angle_deg = GENERATE(62, 118);
  INFO(scene.asked << " of " << scene.works[0].angle_deg << " deg");
  check_answered(scene);
}

// The table comes into its plane where the sheet lies a little askew, and where slots leave the
// table's surface unknown some of the sheet itself is taken for table.
TEST_CASE("a thin sheet on the table is no table") {
  WildScene scene = bare_tee();
  scene.works[0].first.thickness_mm = 1.2;
  scene.works[0].tilt_deg = GENERATE(0.0, 1.5);
  scene.table.slot_pitch_mm = GENERATE(0.0, 50.0);
  INFO("askew by " << scene.works[0].tilt_deg << " deg, slots " << scene.table.slot_pitch_mm
                   << " mm apart");
  check_answered(scene);
}

// Its face begins where the round ends, and the base plate is seen in under it.
TEST_CASE("a hollow section on a plate is a tee, however round its edges are") {
  WildScene scene = bare_tee();
  cell_simulator::WildPlate& upright = scene.works[0].second;
  upright.section = "hollow";
  upright.thickness_mm = 5, upright.depth_mm = 40, upright.away_mm = 60;
  upright.corner_radius_mm = GENERATE(0.0, 8.0, 12.0);
  scene.works[0].gap_begin_mm = scene.works[0].gap_end_mm = GENERATE(0.0, 1.5);
  INFO("radius " << upright.corner_radius_mm << " mm, gap " << scene.works[0].gap_begin_mm
                 << " mm");
  check_answered(scene);
}

// A stripe is rounded where it turns at a plate's edges, and just there all its points are kept.
TEST_CASE("what a stripe shows at the edges of plates side by side does not tilt them") {
  WildScene scene = bare_tee();
  scene.works[0].joint = scene.asked = GENERATE("lap", "butt", "v");
  scene.works[0].second.thickness_mm = scene.asked == "lap" ? 3 : 10;
  scene.works[0].gap_begin_mm = scene.works[0].gap_end_mm = scene.asked == "lap" ? 0 : 1;
  const WildCase wild(scene);
  const seam_t seam = wild.answer(true);
  INFO(scene.asked << " refused with " << seam.refusal << ": " << seam.reason);
  REQUIRE(seam.verdict == seam_t::FOUND);
  const auto& truth = wild.truth().seams.at(0);
  for (int j = 0; j < 2; ++j)
    CHECK(angle_between(Eigen::Vector3d(seam.normals[j]), truth.normals[j]) < 0.03 * kDegree);
  CHECK(std::abs(judge(seam, wild.truth()).start.height) < 0.02);
  // The referee knows their ends where they are claimed, at the plates' own borders.
  CHECK(seam.start_visibility == seam_t::SEEN);
}
