// Which joint two parallel plates make, where it runs and how wide its gap is; and where stripes
// cross the plates' edges: of plates drawn point by point.
#include "services/seam_finding/joints/parallel_joint.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "services/seam_finding/coverage/parallel_stations.hpp"
#include "services/seam_finding/joints/contact.hpp"
#include "services/seam_finding/joints/edges/gap_floor.hpp"
#include "services/seam_finding/joints/parallel_joint_type.hpp"
#include "tests/seam_finding/joints/drawn_plates.hpp"
#include "tests/seam_finding/support/scales.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double turn = 0.05;  // mm across for each mm along

DrawnPlates drawn_butt(double half_gap) {
  DrawnPlates drawn;
  drawn.turn = turn;
  drawn.draw_stripes(drawn_stripes, {drawn.run({-drawn_reach, 0}, {-half_gap, 0}),
                                     drawn.run({half_gap, 0}, {drawn_reach, 0})});
  return drawn;
}

// 60 deg, so wide at the top.
DrawnPlates drawn_groove(double width) {
  DrawnPlates drawn;
  drawn.turn = turn;
  const double depth = 6, below = width / 2 - depth * std::tan(30 * kDegree);
  drawn.draw_stripes(drawn_stripes, {joined(drawn.run({-drawn_reach, 0}, {-width / 2, 0}),
                                            drawn.run({-width / 2, 0}, {-below, -depth})),
                                     joined(drawn.run({below, -depth}, {width / 2, 0}),
                                            drawn.run({width / 2, 0}, {drawn_reach, 0}))});
  return drawn;
}

// The second plate stands so much over the first, with its cut toward the camera at 0.
DrawnPlates drawn_lap(double step) {
  DrawnPlates drawn;
  drawn.turn = turn;
  drawn.camera = {20, -200, 300};
  drawn.heights = {0, step};
  drawn.draw_stripes(
      drawn_stripes,
      {joined(joined(drawn.run({-drawn_reach, 0}, {0, 0}), drawn.run({0, 0}, {0, step})),
              drawn.run({0, step}, {drawn_reach, step}))});
  return drawn;
}

TransitionLine line_of(const DrawnPlates& drawn) {
  TransitionLine line;
  line.frame = drawn.frame;
  line.faces = {0, 1};
  line.transitions = drawn.transitions();
  line.share = 1;
  return line;
}

std::optional<Joint> joint_of(const DrawnPlates& drawn, const std::string& wanted) {
  SeamFindingSettings settings;
  settings.joint_type = wanted;
  return joint_at(drawn.cloud, drawn.faces, line_of(drawn), scales_of_test(drawn.pitch, 0.5),
                  settings);
}

// The line's place across where it passes that place along the search, and its height.
Vector2d at(const Line& line, double along) {
  const Vector3d place = line.at((along - line.point.x()) / line.direction.x());
  return {place.y(), place.z()};
}

}  // namespace

TEST_CASE("a butt joint runs in the middle of its gap, which is as wide as drawn") {
  const DrawnPlates drawn = drawn_butt(0.9);
  const auto joint = joint_of(drawn, "butt");
  REQUIRE(joint);
  CHECK_FALSE(joint->flaw);
  CHECK(joint->type == JointType::kButt);
  CHECK(joint->angle == Approx(M_PI));
  for (const double along : {0.0, 40.0}) {
    CHECK(at(joint->line, along).x() == Approx(turn * along).margin(0.02));
    CHECK(at(joint->parallel->edges[0], along).x() == Approx(-0.9 + turn * along).margin(0.02));
    CHECK(at(joint->parallel->edges[1], along).x() == Approx(0.9 + turn * along).margin(0.02));
  }
  REQUIRE(joint->parallel->gaps.size() == drawn_stripes);
  for (const auto& gap : joint->parallel->gaps) CHECK(gap.width == Approx(1.8).margin(0.02));
  // Nothing is seen in the gap, so that no floor is.
  CHECK_FALSE(joint->parallel->floor);
  CHECK(joint->plates[0].away.y() == Approx(-1).margin(0.01));
  CHECK(joint->plates[1].away.y() == Approx(1).margin(0.01));
  CHECK(joint->coverage.stripes == drawn_stripes);
}

TEST_CASE("a gap wider than a butt joint may have, and a joint not asked for, are flaws") {
  using Code = Reason::Code;
  const auto wide = joint_of(drawn_butt(3), "butt");
  REQUIRE(wide);
  CHECK(wide->flaw.code == Code::kGapWidth);
  CHECK(wide->flaw.number == Approx(6).margin(0.05));
  const auto unwanted = joint_of(drawn_butt(0.9), "v");
  REQUIRE(unwanted);
  CHECK(unwanted->flaw.code == Code::kButtNotWanted);
  const auto lapped = joint_of(drawn_lap(5), "v");
  REQUIRE(lapped);
  CHECK(lapped->flaw);
}

TEST_CASE("a groove's angle is twice the slant drawn, and it runs in the middle") {
  const auto joint = joint_of(drawn_groove(11), "v");
  REQUIRE(joint);
  CHECK_FALSE(joint->flaw);
  CHECK(joint->type == JointType::kV);
  CHECK(joint->parallel->half_angle / kDegree == Approx(30).margin(1));
  CHECK(joint->angle / kDegree == Approx(60).margin(2));
  CHECK(at(joint->line, 20).x() == Approx(turn * 20).margin(0.05));
}

TEST_CASE("a lap runs at the foot of the upper plate's cut, on the lower plate") {
  for (const double step : {3.0, 8.0}) {
    const auto joint = joint_of(drawn_lap(step), "lap");
    INFO(step << " mm");
    REQUIRE(joint);
    CHECK_FALSE(joint->flaw);
    CHECK(joint->type == JointType::kLap);
    CHECK(joint->parallel->lower == 0);
    CHECK(joint->parallel->step == Approx(step).margin(0.02));
    CHECK_FALSE(joint->parallel->root_hidden);
    for (const double along : {0.0, 40.0}) {
      CHECK(at(joint->line, along).x() == Approx(turn * along).margin(0.03));
      CHECK(at(joint->line, along).y() == Approx(0).margin(0.02));
      CHECK(at(joint->parallel->edges[1], along).y() == Approx(step).margin(0.02));
    }
  }
  const auto thick = joint_of(drawn_lap(18), "lap");
  REQUIRE(thick);
  CHECK(thick->flaw.code == Reason::Code::kLapThickness);
}

TEST_CASE("too few stripes make no joint") {
  DrawnPlates drawn;
  drawn.draw_stripes(2,
                     {drawn.run({-drawn_reach, 0}, {-1, 0}), drawn.run({1, 0}, {drawn_reach, 0})});
  CHECK_FALSE(joint_of(drawn, "butt"));
}

TEST_CASE("set_type alone says the type, and nothing of plates that show no edge") {
  const DrawnPlates drawn = drawn_butt(0.9);
  SeamFindingSettings settings;
  settings.joint_type = "any";
  Joint joint;
  for (int j = 0; j < 2; ++j) joint.plates[j].plane = drawn.faces[j].plane;
  for (int j = 0; j < 2; ++j) joint.plates[j].points = drawn.faces[j].points;
  TransitionLine line = line_of(drawn);
  REQUIRE(set_type(drawn.cloud, line, scales_of_test(drawn.pitch, 0.5), settings, joint));
  CHECK(joint.type == JointType::kButt);
  CHECK(joint.parallel->seam.at_middle == Approx(turn * joint.parallel->seam.middle).margin(0.01));
  line.transitions.resize(3);  // fewer than a line needs
  CHECK_FALSE(set_type(drawn.cloud, line, scales_of_test(drawn.pitch, 0.5), settings, joint));
}

TEST_CASE("a plate's reach leaves out a tenth of its points, and its points lie within the noise") {
  const DrawnPlates drawn = drawn_butt(0);
  JointPlate plate;
  plate.points = drawn.faces[1].points;
  plate.away = Vector3d::UnitY();
  const Line border{{0, 0, 0}, Vector3d(1, turn, 0).normalized()};
  // Evenly from the border, which turns by 2.1 mm over the drawn_stripes, to 30 mm.
  CHECK(reach_of(drawn.cloud, plate, border) == Approx(0.9 * drawn_reach + turn * 21).margin(1));

  Scales scales = scales_of_test(3, 0.8, 0);
  const double least = near_plate(scales);
  CHECK(least > 0);
  scales.noise = 0.01 * least;
  CHECK(near_plate(scales) == least);
  scales.noise = least;  // more than a deviation away a point may well lie
  CHECK(near_plate(scales) > least);
  scales.noise = 10;
  CHECK(near_plate(scales) == 0.8);  // never more than the faces' own tolerance
}

TEST_CASE("what touches a line comes as near to it as its points lie apart") {
  const DrawnPlates drawn = drawn_butt(1);
  Face face = drawn.faces[0];
  Scales scales;
  scales.contact = 4;
  face.spacing = 1;
  CHECK(contact_of(face, scales) == 4);
  face.spacing = 5;
  CHECK(contact_of(face, scales) == 10);
  const Line beside{{0, 2, 0}, Vector3d(1, turn, 0).normalized()};  // 3 mm from the edge
  CHECK(touches(drawn.cloud, face.points, beside, 3.01));
  CHECK_FALSE(touches(drawn.cloud, face.points, beside, 2.98));
}

TEST_CASE("each plate's stations lie where stripes cross its own edge, both together half-way") {
  // Stripes at a slant: where they are 3 mm across, they are 0.6 mm further along.
  constexpr double slant = 0.2, half_gap = 3;
  DrawnPlates drawn;
  drawn.draw_stripes(drawn_stripes, {drawn.run({-drawn_reach, 0}, {-half_gap, 0}),
                                     drawn.run({half_gap, 0}, {drawn_reach, 0})});
  for (Vector3d& point : drawn.cloud.points) point.x() += slant * point.y();
  Joint joint;
  joint.line = {Vector3d::Zero(), Vector3d::UnitX()};
  joint.parallel.emplace();
  for (int j = 0; j < 2; ++j) {
    const double side = j == 0 ? -1 : 1;
    joint.plates[j].plane = drawn.faces[j].plane;
    joint.plates[j].points = drawn.faces[j].points;
    joint.plates[j].away = side * Vector3d::UnitY();
    // The second plate's stripes were seen no nearer than 1 mm to its edge.
    joint.parallel->edges[j] = {{0, side * (half_gap - j), 0}, Vector3d::UnitX()};
  }
  const auto by_edge = stations_by_edge(drawn.cloud, joint, scales_of_test(drawn.pitch, 0.5));
  for (int j = 0; j < 2; ++j) {
    REQUIRE(by_edge[j].list.size() == drawn_stripes);
    for (int k = 0; k < drawn_stripes; ++k) {
      const Station& station = by_edge[j].list[k];
      CHECK(station.stripe == k);
      const double edge = joint.parallel->edges[j].point.y();
      CHECK(station.along == Approx(k * drawn.pitch + slant * edge).margin(1e-6));
      CHECK(std::isinf(station.nearest[1 - j]));
    }
    CHECK(by_edge[j].slant[j] == Approx((j == 0 ? -1 : 1) * slant).margin(1e-6));
  }
  CHECK(by_edge[1].list[4].nearest[1] == Approx(1));
  const Stations both = stations_of_both(by_edge);
  REQUIRE(both.list.size() == drawn_stripes);
  for (int k = 0; k < drawn_stripes; ++k) {
    CHECK(both.list[k].along == Approx(k * drawn.pitch + slant * (-3 + 2) / 2).margin(1e-6));
    CHECK(both.list[k].nearest[1] == Approx(1));
    CHECK(both.both(both.list[k]));
  }
}

TEST_CASE(
    "a floor near the plates' tops is told from a cut and from what lies as deep as the table") {
  struct Row {
    const char* what;
    double floor, background;  // mm below the tops
    bool flat, shows;
  };
  for (const Row& row :
       {Row{"a scribed line", 1, 10, true, true}, Row{"a backing", 7, 10, true, false},
        Row{"a cut", 3, 10, false, false}, Row{"no table", 1, 0, true, false}}) {
    DrawnPlates drawn;
    drawn.step = 0.25;
    const DrawnPlates::Piece between =
        row.flat ? drawn.run({-0.8, -row.floor}, {0.8, -row.floor})
                 : drawn.run({0.9, -0.3}, {0.9, -row.floor});  // down on the farther plate's cut
    drawn.draw_stripes(drawn_stripes, {drawn.run({-drawn_reach, 0}, {-1, 0}), between,
                                       drawn.run({1, 0}, {drawn_reach, 0})});
    Segmentation segmentation;
    for (int i = 0; i < drawn.cloud.size(); ++i) segmentation.workpiece.push_back(i);
    if (row.background > 0)
      for (int k = 0; k < drawn_stripes; ++k) {  // the table, seen behind the second plate
        segmentation.background.push_back(drawn.cloud.size());
        drawn.cloud.points.emplace_back(drawn.pitch * k, drawn_reach + 5, -row.background);
        drawn.cloud.origins.push_back({k, 9, true, 0, 0});
      }
    Joint joint;
    joint.line = {Vector3d::Zero(), Vector3d::UnitX()};
    joint.coverage.begin = -1, joint.coverage.end = drawn.pitch * drawn_stripes;
    joint.parallel.emplace();
    for (int j = 0; j < 2; ++j) {
      joint.plates[j].plane = drawn.faces[j].plane;
      joint.plates[j].away = (j == 0 ? -1 : 1) * Vector3d::UnitY();
      joint.parallel->edges[j] = {{0, j == 0 ? -1.0 : 1.0, 0}, Vector3d::UnitX()};
    }
    const DownsampledCloud fewer;
    INFO(row.what);
    CHECK(shows_floor_near_top(ScanView(drawn.cloud, segmentation, fewer), joint,
                               scales_of_test(drawn.pitch, 0.5)) == row.shows);
  }
}
