// Where a plate ends toward the other, a lap's root, a groove's slants, and what stands before or
// lies below: of plates drawn point by point.
#include <catch2/catch.hpp>
#include <cmath>

#include "common/geometry.hpp"
#include "services/seam_finding/joints/edges/lap_root.hpp"
#include "services/seam_finding/joints/edges/plate_end_place.hpp"
#include "services/seam_finding/joints/parallel_edges.hpp"
#include "tests/seam_finding/joints/drawn_plates.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using Eigen::Vector2d;

namespace {

// Plates at one level whose light ends at their edges.
DrawnPlates gap(double from, double to, double turn = 0) {
  DrawnPlates drawn;
  drawn.turn = turn;
  drawn.draw_stripes(drawn_stripes, {drawn.run({-drawn_reach, 0}, {from, 0}),
                                     drawn.run({to, 0}, {drawn_reach, 0})});
  return drawn;
}

// A groove whose slants lean so much from the normal; it is as wide at the top as it is said.
DrawnPlates groove(double slant_deg, double width, double depth) {
  DrawnPlates drawn;
  const double below = width / 2 - depth * std::tan(slant_deg * kDegree);
  drawn.draw_stripes(drawn_stripes, {joined(drawn.run({-drawn_reach, 0}, {-width / 2, 0}),
                                            drawn.run({-width / 2, 0}, {-below, -depth})),
                                     joined(drawn.run({below, -depth}, {width / 2, 0}),
                                            drawn.run({width / 2, 0}, {drawn_reach, 0}))});
  return drawn;
}

// The second plate lies 6 mm over the first; its cut stands on it at `root`, seen from `camera_y`.
DrawnPlates lap(double root, double turn, double camera_y, double cut_leans = 0) {
  constexpr double thickness = 6;
  DrawnPlates drawn;
  drawn.turn = turn;
  drawn.camera = {20, camera_y, 300};
  drawn.heights = {0, thickness};
  const Vector2d foot(root, 0), top(root + cut_leans * thickness, thickness);
  if (camera_y < 0 || cut_leans > 0)  // the cut is seen
    drawn.draw_stripes(drawn_stripes,
                       {joined(joined(drawn.run({-drawn_reach, 0}, foot), drawn.run(foot, top)),
                               drawn.run(top, {drawn_reach, thickness}))});
  else
    drawn.draw_stripes(drawn_stripes, {drawn.run({-drawn_reach, 0}, {root - 4, 0}),
                                       drawn.run(top, {drawn_reach, 6})});
  return drawn;
}

std::optional<LapRoot> root_of(const DrawnPlates& drawn) {
  return lap_root(drawn.cloud, drawn.transitions(), drawn.frame, drawn.planes(), 1, 6,
                  DrawnPlates::near, drawn.step);
}

ParallelEdges edges_of(const DrawnPlates& drawn) {
  return edges_of(drawn.cloud, drawn.transitions(), drawn.frame, drawn.planes(), DrawnPlates::near,
                  drawn.step);
}

}  // namespace

TEST_CASE("a plate ends at its segment's end, or half-way to what follows in the segment") {
  DrawnPlates drawn;
  // The first plate's stripe goes on by two points that are on neither; the second's begins anew.
  drawn.draw_stripe({joined(drawn.run({-drawn_reach, 0}, {-2, 0}), {{-1.2, -1}, {-0.8, -2}}),
                     drawn.run({3, 0}, {drawn_reach, 0})});
  const Transition transition = drawn.transitions().at(0);
  const auto across = [&](int i) { return drawn.cloud.points[i].y(); };
  CHECK(across(last_on_plate(transition, 0)) == Approx(-2));
  CHECK(across(last_on_plate(transition, 1)) == Approx(3));
  REQUIRE(follower(drawn.cloud, transition, 0) >= 0);
  CHECK(across(follower(drawn.cloud, transition, 0)) == Approx(-1.2));
  CHECK(follower(drawn.cloud, transition, 1) == -1);

  const auto end = [&](int plate, int next) {
    return end_place(drawn.cloud, transition, drawn.frame, plate, next, 1.0);
  };
  CHECK(end(0, follower(drawn.cloud, transition, 0)).across == Approx((-2 - 1.2) / 2));
  CHECK(end(0, -1).across == Approx(-2 + 1.0 / 2));  // half a pitch where nothing follows
  CHECK(end(1, -1).across == Approx(3));
  CHECK(end(1, -1).height == 0);
  // An even distribution over the pitch.
  CHECK(end(0, -1).deviation == Approx(1 / std::sqrt(12.0)));
}

TEST_CASE("what follows a plate's last point is the other plate's where nothing lies between") {
  DrawnPlates drawn;
  drawn.heights = {0, 1};
  drawn.draw_stripe(
      {joined(drawn.run({-drawn_reach, 0}, {-0.5, 0}), drawn.run({0.5, 1}, {drawn_reach, 1}))});
  const Transition transition = drawn.transitions().at(0);
  CHECK(follower(drawn.cloud, transition, 0) == last_on_plate(transition, 1));
  CHECK(follower(drawn.cloud, transition, 1) == last_on_plate(transition, 0));
}

TEST_CASE(
    "plates between which light ends are as drawn_reach apart as it was drawn, turned or not") {
  for (const double turn : {0.0, 0.1}) {
    const ParallelEdges edges = edges_of(gap(-0.8, 1.4, turn));
    REQUIRE(edges.plates[0]);
    REQUIRE(edges.plates[1]);
    for (const double along : {0.0, 40.0}) {
      CHECK(edges.plates[0]->across_at(along) == Approx(-0.8 + turn * along).margin(1e-6));
      CHECK(edges.plates[1]->across_at(along) == Approx(1.4 + turn * along).margin(1e-6));
    }
    CHECK_FALSE(edges.slants[0]);
    CHECK_FALSE(edges.slants[1]);
    CHECK(edges.depth == 0);
  }
}

TEST_CASE("a groove's slants and its edges at the top are those drawn") {
  for (const double slant : {25.0, 35.0}) {
    const ParallelEdges edges = edges_of(groove(slant, 10, 6));
    REQUIRE(edges.plates[0]);
    REQUIRE(edges.plates[1]);
    REQUIRE(edges.slants[0]);
    REQUIRE(edges.slants[1]);
    CHECK(*edges.slants[0] / kDegree == Approx(slant).margin(1));
    CHECK(*edges.slants[1] / kDegree == Approx(slant).margin(1));
    CHECK(edges.plates[0]->across_at(20) == Approx(-5).margin(0.1));
    CHECK(edges.plates[1]->across_at(20) == Approx(5).margin(0.1));
    CHECK(edges.depth == Approx(6).margin(0.01));
  }
}

TEST_CASE("a lap's root is the foot of the cut where it is seen") {
  const auto root = root_of(lap(1, 0.05, -200));
  REQUIRE(root);
  CHECK(root->seen);
  CHECK_FALSE(root->faces_away);
  for (const double along : {0.0, 40.0})
    CHECK(root->fit.across_at(along) == Approx(1 + 0.05 * along).margin(0.02));
}

TEST_CASE("where the cut faces away from the camera a lap's root is under the upper plate's end") {
  const auto root = root_of(lap(1, 0, 300));
  REQUIRE(root);
  CHECK_FALSE(root->seen);
  CHECK(root->faces_away);
  CHECK(root->fit.across_at(20) == Approx(1).margin(0.02));
}

TEST_CASE("a bead that slants from the upper plate down is no cut") {
  CHECK_FALSE(root_of(lap(1, 0, -200, 1)));
}

TEST_CASE("what lies between is below both plates, before both, or neither") {
  struct Row {
    double out;  // of what lies between; mm
    bool below, covered;
  };
  // The second plate lies 4 mm over the first.
  for (const Row& row : {Row{-3, true, false}, Row{-0.2, false, false}, Row{2, false, false},
                         Row{4.2, false, false}, Row{7, false, true}}) {
    DrawnPlates drawn;
    drawn.heights = {0, 4};
    drawn.draw_stripe(
        {joined(joined(drawn.run({-drawn_reach, 0}, {-2, 0}), {{-0.5, row.out}, {0.5, row.out}}),
                drawn.run({2, 4}, {drawn_reach, 4}))});
    const auto transitions = drawn.transitions();
    REQUIRE(transitions.size() == 1);
    INFO("between at " << row.out << " mm");
    CHECK(sees_below(drawn.cloud, transitions[0], drawn.planes(), DrawnPlates::near) == row.below);
    CHECK(is_covered(drawn.cloud, transitions[0], drawn.planes(), DrawnPlates::near) ==
          row.covered);
    CHECK(showing_edges(drawn.cloud, transitions, drawn.planes(), DrawnPlates::near).empty() ==
          row.covered);
  }
}
