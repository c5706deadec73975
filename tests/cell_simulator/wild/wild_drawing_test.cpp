#include <catch2/catch.hpp>
#include <cstdio>
#include <map>

#include "services/cell_simulator/wild/wild_build.hpp"
#include "services/cell_simulator/wild/wild_json.hpp"
#include "tests/cell_simulator/wild/winding.hpp"

namespace arcstart::cell_simulator {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t seeds = 100;

// Near the seam's end the plate's own triangles are there inside its edge, and not outside it.
void check_edge(const TriangleMesh& plate, const WildSeam& seam, const WildEnd& end, int side,
                int which) {
  constexpr double off_mm = 0.3, through_mm = 0.6;
  const double play = end.play_mm + end.edge_play_mm[which];
  // As far from the seam as the flat face begins.
  const double away = 1.2 * (seam.reach_mm - std::max(seam.gap_start, seam.gap_end) - 7.2);
  const Vector3d at = end.edge_points[which] + away * end.edge_directions[which];
  const Vector3d in = side * seam.direction, normal = through_mm * seam.normals[which];
  // A cut aslant comes out under the face.
  const auto there = [&](const Vector3d& p) { return meets(plate, p + normal, p - normal / 2); };
  CHECK(there(at + (play + off_mm) * in));
  CHECK_FALSE(there(at - (play + off_mm) * in));
}

}  // namespace

TEST_CASE("A hundred scenes of each joint are what their truth says", "[figures]") {
  for (const char* joint : wild_joints) {
    std::map<std::string, int> kinds;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      CAPTURE(joint, seed);
      const WildScene wild = draw_wild_scene(joint, seed);
      const Scene scene = build(wild, SceneKind::workpiece);
      const WildTruth truth = truth_of(wild);
      REQUIRE(surfaces_of(wild, SceneKind::workpiece).size() == 2 * scene.objects().size());
      for (const WildSeam& seam : truth.seams) {
        CHECK((seam.end.point - seam.start.point).norm() > 20);
        CHECK(std::abs(seam.normals[0].dot(seam.direction)) < 0.06);
        for (const WildEnd* end : {&seam.start, &seam.end})
          for (int plate = 0; plate < 2; ++plate)
            if (end->plate == plate || end->plate == 2)
              check_edge(scene.objects()[seam.objects[plate]].mesh, seam, *end,
                         end == &seam.start ? 1 : -1, plate);
        // Just off the corner of both plates there is air, but for weld metal, and what lies about
        // has not swallowed it.
        for (const SceneObject& object : scene.objects()) {
          if (object.name == "table" || object.name == "bead" || object.name == "tab") continue;
          // Between tops of unlike height the seam lies in the higher plate.
          const bool level = seam.joint_type == "butt" || seam.joint_type == "v";
          if (level && object.name.ends_with("plate")) continue;
          for (const Vector3d& p : {seam.start.point, seam.end.point}) {
            const Vector3d aside = seam.joint_type == "lap"
                                       ? Vector3d(seam.direction.cross(seam.normals[0]))
                                       : seam.normals[1];
            const Vector3d off = p + 0.05 * (seam.normals[0] + aside);
            CAPTURE(object.name);
            CHECK(winding(object.mesh, off) < 0.5);
          }
        }
      }
      ++kinds["all"];
      kinds["wrong"] += truth.wrong;
      kinds["several seams"] += truth.seams.size() > 1;
      kinds["nothing lies about"] += wild.solids.empty();
      kinds["slotted table"] += wild.table.slot_pitch_mm > 0;
      kinds["events"] += wild.events.wire_radius_mm > 0 || wild.events.arc_grey > 0 ||
                         wild.events.sun_grey > 0 || wild.events.flicker_grey > 0 ||
                         wild.events.shake_mm > 0 || wild.events.spoilt_share > 0;
      if (wild.works.empty()) continue;
      const WildWork& work = wild.works[0];
      kinds["sheet"] += work.first.thickness_mm <= 3 || work.second.thickness_mm <= 3;
      kinds["gap"] += work.gap_begin_mm > 0;
      kinds["bow"] += work.bow_mm != 0;
      kinds["ground band"] += work.first.ground_mm > 0 || work.second.ground_mm > 0;
      for (const WildPlate* plate : {&work.first, &work.second}) {
        if (plate->ground_mm == 0) continue;
        CHECK(plate->surface == mill_scale);
        CHECK(plate->ground_mm >= 10);
        CHECK(plate->ground_mm <= 30);
      }
      kinds["beads"] += !work.beads.empty();
      kinds["turned cut at the start"] +=
          work.first.begin.turn_deg != 0 || work.second.begin.turn_deg != 0;
      kinds["cope at the start"] += work.second.begin.cope_mm > 0;
      kinds["base later than the upright"] += work.first.begin.at_mm > work.second.begin.at_mm;
      kinds["section"] += work.first.section != "plate" || work.second.section != "plate";
      kinds["search begins late"] +=
          wild.scan.begin_mm > -work.position_mm[0] + 950 + work.second.begin.at_mm;
    }
    std::printf("%s:", joint);
    for (const auto& [kind, count] : kinds) std::printf(" %s %d;", kind.c_str(), count);
    std::printf("\n");
    CHECK(kinds["nothing lies about"] > 20);
    CHECK(kinds["nothing lies about"] < 50);
    CHECK(kinds["wrong"] < 20);
    CHECK(kinds["bow"] > 5);
    CHECK(kinds["ground band"] > 2);
    CHECK(kinds["ground band"] < 30);
    CHECK(kinds["turned cut at the start"] > 20);
  }
}

TEST_CASE("The same joint and seed draw the same scene, others another") {
  CHECK(to_json(draw_wild_scene("tee", 12)) == to_json(draw_wild_scene("tee", 12)));
  CHECK(to_json(draw_wild_scene("tee", 12)) != to_json(draw_wild_scene("tee", 13)));
  CHECK(to_json(draw_wild_scene("tee", 12)) != to_json(draw_wild_scene("inside_corner", 12)));
  CHECK_THROWS_AS(draw_wild_scene("weld", 1), SceneError);
}

TEST_CASE("A plate is ground beside the seam, as far as it says, wherever the work lies") {
  WildScene wild = draw_wild_scene("tee", 12);
  wild.works.resize(1);
  wild.works[0].bow_mm = 0;
  wild.works[0].first.ground_mm = 20;
  wild.works[0].second.ground_mm = 12;
  const Scene scene = build(wild, SceneKind::workpiece);
  const WildTruth truth = truth_of(wild);
  REQUIRE(!truth.seams.empty());
  const WildSeam& seam = truth.seams[0];
  const Vector3d middle = (seam.start.point + seam.end.point) / 2;
  for (int j = 0; j < 2; ++j) {
    const auto& band = scene.objects()[seam.objects[j]].band;
    REQUIRE(band);
    CHECK(band->surface.albedo == ground_steel.albedo);
    // Away from the seam in the plate's own face.
    const Vector3d away = seam.normals[j].cross(seam.direction);
    const double width = j == 0 ? 20 : 12;
    const double gap = std::max(seam.gap_start, seam.gap_end) + 0.1;
    for (const double side : {-1.0, 1.0}) {
      CHECK(band->contains(middle + side * (width - gap) * away));
      CHECK_FALSE(band->contains(middle + side * (width + gap) * away));
    }
  }
  CHECK(to_json(wild_scene_from_json(to_json(wild))) == to_json(wild));
}

TEST_CASE("A background scan shows the table and what lay there alone") {
  WildScene scene = draw_wild_scene("tee", 2);
  WildSolid gone, here;
  gone.with_work = false;
  gone.with_background = true;
  gone.position_mm = here.position_mm = {950, 0, 10};
  scene.solids = {gone, here};
  const Scene background = build(scene, SceneKind::background);
  REQUIRE(background.objects().size() == 2);
  CHECK_FALSE(background.seam());
  CHECK(build(scene, SceneKind::workpiece).objects().size() >= 4);
}

}  // namespace arcstart::cell_simulator
