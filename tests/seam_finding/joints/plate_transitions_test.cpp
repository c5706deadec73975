// Which points of a stripe are a transition from plate to plate, of plates drawn point by point.
#include <catch2/catch.hpp>
#include <cmath>

#include "services/seam_finding/joints/straight_runs.hpp"
#include "tests/seam_finding/joints/drawn_plates.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

double across(const DrawnPlates& drawn, int i) { return drawn.cloud.points[i].y(); }

}  // namespace

TEST_CASE("a stripe's segments are put in order across, each with its smaller end first") {
  DrawnPlates drawn;
  drawn.draw_stripe({drawn.run({20, 0}, {5, 0}), drawn.run({-20, 0}, {-5, 0})});
  const auto sections = sections_across(drawn.cloud, drawn.frame, 1);
  REQUIRE(sections.size() == 1);
  REQUIRE(static_cast<int>(sections[0].size()) == drawn.cloud.size());
  for (std::size_t i = 1; i < sections[0].size(); ++i)
    CHECK(across(drawn, sections[0][i - 1]) < across(drawn, sections[0][i]));
}

TEST_CASE("without stripes a section is a slice as wide as the spacing") {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 60; ++i) points.emplace_back(0.1 + i % 3 * 2, 30 - i, 0);
  const ScanCloud cloud = unorganised_cloud(points);
  const auto sections = sections_across(cloud, DrawnPlates{}.frame, 2);
  REQUIRE(sections.size() == 3);
  for (const Section& section : sections) {
    CHECK(section.size() == 20);
    for (std::size_t i = 1; i < section.size(); ++i) {
      CHECK(cloud.points[section[i - 1]].x() == cloud.points[section[i]].x());
      CHECK(cloud.points[section[i - 1]].y() < cloud.points[section[i]].y());
    }
  }
}

TEST_CASE("between two faces each stripe has one transition, with what lies between") {
  DrawnPlates drawn;
  drawn.heights = {0, 2};
  drawn.draw_stripes(5, {joined(joined(drawn.run({-20, 0}, {-1, 0}), {{-0.5, 0.7}, {0.5, 1.4}}),
                                drawn.run({1, 2}, {20, 2}))});
  const auto transitions = drawn.transitions();
  REQUIRE(transitions.size() == 5);
  for (std::size_t k = 0; k < transitions.size(); ++k) {
    CHECK(transitions[k].section == static_cast<int>(k));
    CHECK(across(drawn, transitions[k].last) == Approx(-1));
    CHECK(across(drawn, transitions[k].first) == Approx(1));
    CHECK(transitions[k].between.size() == 2);
    CHECK(transitions[k].rising);
  }
  // Asked for the other way round they lead back.
  for (const Transition& transition :
       transitions_between(drawn.cloud, drawn.sections, drawn.face_of, drawn.faces, 1, 0, 0.15))
    CHECK_FALSE(transition.rising);
}

TEST_CASE("a face's points far from its plane lie between; its segments' ends never do") {
  DrawnPlates drawn;
  drawn.draw_stripe({drawn.run({-20, 0}, {-1, 0}), drawn.run({1, 0}, {20, 0})});
  const int last = drawn.transitions().at(0).last;
  for (const int i : {last - 1, last}) drawn.cloud.points[i].z() = 0.4;  // still the face's own
  const auto transition = [&] {
    const auto all =
        transitions_between(drawn.cloud, drawn.sections, drawn.face_of, drawn.faces, 0, 1, 0.15);
    REQUIRE(all.size() == 1);
    return all[0];
  };
  CHECK(transition().last == last);
  CHECK(transition().between.empty());
  drawn.cloud.origins[last].segment_end = false;
  CHECK(transition().last == last - 2);
  CHECK(transition().between == std::vector<int>{last - 1, last});
}

TEST_CASE("within one face light that ends and begins again is a transition") {
  DrawnPlates drawn;
  drawn.draw_stripes(4, {drawn.run({-20, 0}, {-1, 0}), drawn.run({1, 0}, {20, 0})});
  std::fill(drawn.face_of.begin(), drawn.face_of.end(), 0);
  const auto parted =
      transitions_between(drawn.cloud, drawn.sections, drawn.face_of, drawn.faces, 0, 0, 0.15);
  REQUIRE(parted.size() == 4);
  CHECK(across(drawn, parted[2].last) == Approx(-1));
  DrawnPlates whole;
  whole.draw_stripes(4, {whole.run({-20, 0}, {20, 0})});
  std::fill(whole.face_of.begin(), whole.face_of.end(), 0);
  CHECK(transitions_between(whole.cloud, whole.sections, whole.face_of, whole.faces, 0, 0, 0.15)
            .empty());
}

TEST_CASE("plates at two levels that one face holds are parted by their straight runs") {
  for (const double step : {0.6, -0.6}) {
    DrawnPlates drawn;
    drawn.heights = {0, step};
    drawn.draw_stripes(
        5, {joined(drawn.run({-20, 0}, {-0.5, 0}), drawn.run({0.5, step}, {20, step}))});
    std::fill(drawn.face_of.begin(), drawn.face_of.end(), 0);
    const auto transitions = transitions_within(drawn.cloud, drawn.sections, drawn.frame,
                                                drawn.face_of, 0, 0, DrawnPlates::near);
    REQUIRE(transitions.size() == 5);
    for (const Transition& transition : transitions) {
      CHECK(across(drawn, transition.last) == Approx(-0.5));
      CHECK(across(drawn, transition.first) == Approx(0.5));
      CHECK(transition.between.empty());
    }
  }
  DrawnPlates flat;
  flat.draw_stripes(5, {flat.run({-20, 0}, {20, 0})});
  std::fill(flat.face_of.begin(), flat.face_of.end(), 0);
  CHECK(transitions_within(flat.cloud, flat.sections, flat.frame, flat.face_of, 0, 0,
                           DrawnPlates::near)
            .empty());
}
