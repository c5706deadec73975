#include <catch2/catch.hpp>
#include <cmath>

#include "services/cell_simulator/wild/wild_build.hpp"
#include "tests/cell_simulator/wild/winding.hpp"

namespace arcstart::cell_simulator {
namespace {

using Eigen::Vector3d;

constexpr double degree = 3.14159265358979323846 / 180;

// A base plate of 160 mm, 10 thick, and an upright of 100 mm, 40 high, in the middle of the table.
WildScene plain(const std::string& joint = "tee") {
  WildScene scene;
  scene.asked = joint;
  WildWork work;
  work.joint = joint;
  work.first.thickness_mm = 10;
  work.first.away_mm = 50;
  work.first.behind_mm = joint == "tee" || joint == "lap" ? 40 : 0;
  work.first.begin.at_mm = -80;
  work.first.end.at_mm = 80;
  work.second.thickness_mm = joint == "tee" || joint == "lap" ? 8 : 10;
  work.second.away_mm = 40;
  work.second.begin.at_mm = -50;
  work.second.end.at_mm = 50;
  scene.works = {work};
  return scene;
}

WildSeam seam_of(const WildScene& scene) {
  const WildTruth truth = truth_of(scene);
  REQUIRE(truth.seams.size() == 1);
  return truth.seams[0];
}

void check_near(const Vector3d& a, const Vector3d& b, double within = 1e-6) {
  CAPTURE(a.transpose(), b.transpose());
  CHECK((a - b).norm() < within);
}

}  // namespace

TEST_CASE("A tee's truth by hand") {
  const WildSeam seam = seam_of(plain());
  CHECK(seam.joint_type == "tee");
  check_near(seam.start.point, {900, 0, 10});
  check_near(seam.end.point, {1000, 0, 10});
  check_near(seam.direction, {1, 0, 0});
  check_near(seam.normals[0], {0, 0, 1});
  check_near(seam.normals[1], {0, -1, 0});
  CHECK(seam.angle == Approx(90 * degree));
  CHECK(seam.start.plate == 1);
  CHECK(seam.start.play_mm == 0);
}

TEST_CASE("A seam starts at the foot, however the upright is cut above it") {
  WildScene scene = plain();
  WildCut& cut = scene.works[0].second.begin;
  cut.turn_deg = 20;
  check_near(seam_of(scene).start.point, {900, 0, 10});
  double least = 1e9;
  const Scene built = build(scene, SceneKind::workpiece);
  for (const Vector3d& corner : built.objects()[2].mesh.corners)
    least = std::min(least, corner.x());
  CHECK(least == Approx(900 - 40 * std::tan(20 * degree)));
  check_near(seam_of(scene).start.edge_directions[1],
             Vector3d(-std::sin(20 * degree), 0, std::cos(20 * degree)));

  cut.slant_deg = 15;
  check_near(seam_of(scene).start.point, {900, 0, 10});
  cut.chamfer_mm = 1.5;
  check_near(seam_of(scene).start.point, {901.5, 0, 10});
  CHECK(seam_of(scene).start.play_mm == Approx(1.5));
  cut.chamfer_mm = 0;
  cut.wave_mm = 0.5;
  cut.wave_phase_deg = 90;  // a crest at the foot
  check_near(seam_of(scene).start.point, {899.5, 0, 10});
  cut.wave_mm = 0;
  cut.cope_mm = 12;
  check_near(seam_of(scene).start.point, {912, 0, 10});
}

TEST_CASE("The first of the plates to end bounds the seam") {
  WildScene scene = plain();
  scene.works[0].first.begin.at_mm = -42;
  scene.works[0].first.end.at_mm = 50.02;
  scene.works[0].first.begin.turn_deg = 30;
  const WildSeam seam = seam_of(scene);
  check_near(seam.start.point, {908, 0, 10});
  CHECK(seam.start.plate == 0);
  check_near(seam.start.edge_directions[0], Vector3d(-0.5, -std::sqrt(0.75), 0));
  CHECK(seam.end.plate == 2);
}

TEST_CASE("A leaning upright's normal, and gaps that grow along the seam") {
  WildScene scene = plain();
  scene.works[0].angle_deg = 60;
  scene.works[0].gap_begin_mm = 0.5;
  scene.works[0].gap_end_mm = 2.5;
  const WildSeam seam = seam_of(scene);
  check_near(seam.normals[1], {0, -std::sin(60 * degree), -std::cos(60 * degree)});
  check_near(seam.start.point, {900, 0, 10});
  CHECK(seam.gap_start == Approx(0.5));
  CHECK(seam.gap_end == Approx(2.5));
}

TEST_CASE("Truth of laps, butt joints, grooves and corners by hand") {
  WildScene lap = plain("lap");
  lap.works[0].gap_begin_mm = lap.works[0].gap_end_mm = 1;
  CHECK(seam_of(lap).thickness == Approx(9));
  check_near(seam_of(lap).start.point, {900, 0, 10});
  check_near(seam_of(lap).normals[1], {0, 0, 1});

  WildScene butt = plain("butt");
  butt.works[0].mismatch_begin_mm = butt.works[0].mismatch_end_mm = 1;
  check_near(seam_of(butt).start.point, {900, 0, 10.5});
  CHECK(seam_of(butt).angle == Approx(180 * degree));

  WildScene groove = plain("v");
  groove.works[0].groove_deg = 60;
  groove.works[0].root_face_mm = 2;
  groove.works[0].gap_begin_mm = groove.works[0].gap_end_mm = 3;
  check_near(seam_of(groove).start.point, {900, 0, 10});
  CHECK(seam_of(groove).angle == Approx(60 * degree));
  // The groove's flank meets the top at half the gap and 8 mm of slant.
  const Scene scene = build(groove, SceneKind::workpiece);
  double nearest = -1e9;
  for (const Vector3d& corner : scene.objects()[1].mesh.corners)
    if (corner.z() > 9.999) nearest = std::max(nearest, corner.y());
  CHECK(nearest == Approx(-1.5 - 8 * std::tan(30 * degree)));

  // The first plate goes on by 30 mm; turned by 45 deg its face there ends 1.5 mm before the seam.
  groove.works[0].root_face_mm = 0;
  groove.works[0].groove_deg = 2 * std::atan(3.15) / degree;
  groove.works[0].first.begin.turn_deg = -45;
  check_near(seam_of(groove).start.point, {900, 0, 10});
  CHECK(seam_of(groove).start.play_mm == Approx(1.5));
  CHECK(seam_of(groove).end.play_mm == 0);

  const WildSeam inside = seam_of(plain("inside_corner"));
  CHECK(inside.joint_type == "corner");
  check_near(inside.normals[1], {0, -1, 0});

  const WildSeam outside = seam_of(plain("outside_corner"));
  check_near(outside.start.point, {900, 0, 40});
  check_near(outside.normals[0], {0, 0, 1});
  check_near(outside.normals[1], {0, -1, 0});
  CHECK(outside.angle == Approx(270 * degree));
}

TEST_CASE(
    "However an outside corner's plates meet, its seam lies where the outer faces' planes do") {
  // The edges toward the seam: across of the first plate's, height of the second's over the table.
  const auto edges = [](const std::string& corner) {
    WildScene scene = plain("outside_corner");
    scene.works[0].corner = corner;
    scene.works[0].first.thickness_mm = 8;
    const WildSeam seam = seam_of(scene);
    check_near(seam.start.point - seam.end.point, {-100, 0, 0});
    const Scene built = build(scene, SceneKind::workpiece);
    double first = 1e9, second = -1e9;
    for (const Vector3d& place : built.objects()[1].mesh.corners)
      first = std::min(first, place.y() - seam.start.point.y());
    for (const Vector3d& place : built.objects()[2].mesh.corners)
      second = std::max(second, place.z() - seam.start.point.z());
    return Eigen::Vector2d(first, second);
  };
  CHECK((edges("mitred") - Eigen::Vector2d(0, 0)).norm() < 1e-6);
  CHECK((edges("over") - Eigen::Vector2d(0, -8)).norm() < 1e-6);
  CHECK((edges("butted") - Eigen::Vector2d(10, 0)).norm() < 1e-6);
  CHECK((edges("open") - Eigen::Vector2d(10, -8)).norm() < 1e-6);
  CHECK_THROWS(edges("round"));
}

TEST_CASE("The plates of an outside corner that leans do not reach into each other") {
  for (const double angle : {76.0, 104.0})
    for (const std::string corner : {"over", "butted", "open"}) {
      INFO(corner << " at " << angle);
      WildScene scene = plain("outside_corner");
      scene.works[0].corner = corner;
      scene.works[0].angle_deg = angle;
      const Scene built = build(scene, SceneKind::workpiece);
      const Vector3d line = seam_of(scene).start.point;
      const double lean = (90 - angle) * degree;
      // Into each plate from its face, and away from the seam within it; both are 10 mm thick.
      const std::array<Vector3d, 2> into{Vector3d(0, 0, -1),
                                         Vector3d(0, std::cos(lean), std::sin(lean))},
          away{Vector3d(0, 1, 0), Vector3d(0, std::sin(lean), -std::cos(lean))};
      double nearest = 1e9;
      for (const int plate : {0, 1}) {
        double edge = 1e9;
        for (const Vector3d& place : built.objects()[1 + plate].mesh.corners)
          edge = std::min(edge, away[plate].dot(place - line));
        for (const Vector3d& place : built.objects()[2 - plate].mesh.corners) {
          const double depth = into[plate].dot(place - line), t = away[plate].dot(place - line);
          const double off = std::max({-depth, depth - 10, edge - t});
          CHECK(off > -1e-6);
          nearest = std::min(nearest, off);
        }
      }
      // They touch; where the corner is obtuse, the edge cut square to its face stands off a
      // little.
      CHECK(nearest < (angle > 90 ? 10 * (1 / std::cos(lean) - 1) + 0.5 : 1e-6));
    }
}

TEST_CASE("A bowed work's seam is an arc of that height") {
  WildScene scene = plain();
  scene.works[0].bow_mm = 1;
  const WildSeam seam = seam_of(scene);
  CHECK(seam.bow_mm == Approx(1).epsilon(0.01));
  // Its middle is the lowest: the base plate's underside rests there on the table.
  CHECK(seam.start.point.z() == Approx(11).margin(0.02));
  CHECK(seam.start.point.x() == Approx(900).margin(0.15));
  CHECK(seam.normals[0].x() == Approx(std::sin(50.0 / 1250)).epsilon(1e-3));
}

TEST_CASE("A turned and tilted work carries its truth along") {
  WildScene scene = plain();
  scene.works[0].yaw_deg = 30;
  const WildSeam turned = seam_of(scene);
  check_near(turned.start.point, {950 - 50 * std::cos(30 * degree), -25, 10});
  scene.works[0].yaw_deg = 0;
  scene.works[0].tilt_deg = 6;
  scene.works[0].tilt_axis_deg = 90;  // about y: the far end goes down
  const WildSeam tilted = seam_of(scene);
  check_near(tilted.direction, {std::cos(6 * degree), 0, -std::sin(6 * degree)});
}

TEST_CASE("Ribs and second works are seams as well, wrong parts are none") {
  WildScene scene = plain();
  scene.works[0].ribs = {{25, 8, 30, -40, 45}};
  WildTruth truth = truth_of(scene);
  REQUIRE(truth.seams.size() == 2);
  check_near(truth.seams[1].start.point, {910, 25, 10});
  check_near(truth.seams[1].end.point, {995, 25, 10});
  CHECK(build(scene, SceneKind::workpiece).objects()[truth.seams[1].objects[1]].name == "rib");

  scene.works.push_back(plain().works[0]);
  scene.works[1].position_mm[0] = 1150;
  truth = truth_of(scene);
  REQUIRE(truth.seams.size() == 3);
  check_near(truth.seams[2].start.point, {1100, 0, 10});
  CHECK(build(scene, SceneKind::workpiece).objects()[truth.seams[2].objects[1]].name ==
        "second plate");

  scene = plain();
  scene.works[0].upside_down = true;
  CHECK(truth_of(scene).wrong);
  scene.works[0].upside_down = false;
  scene.asked = "lap";
  CHECK(truth_of(scene).wrong);
}

TEST_CASE("A known ray meets the known point of a hollow section and of a hole") {
  WildScene scene = plain();
  WildPlate& upright = scene.works[0].second;
  upright.section = "hollow";
  upright.thickness_mm = 3;
  upright.depth_mm = 40;
  upright.corner_radius_mm = 6;
  const auto first_hit = [&](const Vector3d& from, const Vector3d& to) -> Vector3d {
    const double share = build(scene, SceneKind::workpiece).triangles().first_hit(from, to);
    return from + share * (to - from);
  };
  // Its flat face, and the middle of its lower corner's radius.
  check_near(first_hit({950, -100, 30}, {950, 100, 30}), {950, 0, 30});
  const double in = 6 * (1 - std::sqrt(0.5));
  check_near(first_hit({950, -100, 10 + in}, {950, 100, 10 + in}), {950, in, 10 + in}, 0.02);
  // Through its open end, onto the inside of its lower wall.
  check_near(first_hit({850, 20, 33}, {950, 20, 3}), {916.666667, 20, 13}, 1e-4);

  scene.works[0].second = plain().works[0].second;
  scene.works[0].second.holes = {{0, 25, 6}};
  CHECK(build(scene, SceneKind::workpiece).triangles().first_hit({950, -100, 35}, {950, 100, 35}) >
        1);
  check_near(first_hit({957, -100, 35}, {957, 100, 35}), {957, 0, 35});
}

}  // namespace arcstart::cell_simulator
