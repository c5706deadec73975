#include "services/seam_finding/referee/edge_line.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace arcstart::seam_finding;

namespace {

// Out of what follows each other away from the seam: the edge's foot, its slope, and by how much
// each place is off.
std::vector<EdgeMark> along_edge(double foot, double slope, const std::vector<double>& off) {
  std::vector<EdgeMark> marks;
  for (std::size_t i = 0; i < off.size(); ++i) {
    const double away = 8 + 7 * static_cast<double>(i);
    marks.push_back({foot + slope * away + off[i], away});
  }
  return marks;
}

}  // namespace

TEST_CASE("a square edge is known by the mean of its crossings") {
  const auto line = line_through(along_edge(-1, 0, {0.05, -0.05, 0.04, -0.04}));
  REQUIRE(line);
  CHECK(std::abs(line->foot + 1) < 0.01);
  CHECK(line->deviation < 0.05);
}

TEST_CASE("a slanting edge is followed to the seam, and less sure") {
  for (const double slope : {-0.4, 0.1, 0.4}) {
    const auto line = line_through(along_edge(2, slope, {0, 0, 0}));
    INFO("slope " << slope);
    REQUIRE(line);
    CHECK(std::abs(line->foot - 2) < 1e-9);
    CHECK(line->deviation > 0.15);
    CHECK(line->deviation < 0.4);
  }
}

TEST_CASE("what is off the line of most crossings does not count") {
  const auto line = line_through(along_edge(0, 0, {0, 0, 4, 0}));
  REQUIRE(line);
  CHECK(std::abs(line->foot) < 1e-9);
}

TEST_CASE("one crossing, or a few that lie on no line, tell no edge") {
  CHECK_FALSE(line_through({}));
  CHECK_FALSE(line_through(along_edge(0, 0, {0})));
  CHECK_FALSE(line_through(along_edge(0, 0, {0, 3, -3, 2, 0})));
  // Steeper than an edge is cut.
  CHECK_FALSE(line_through({{0, 10}, {7, 20}}));
}

TEST_CASE("the foot of a noisy edge lies within what its deviation says") {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.06);
  for (const double slope : {0.0, 0.3}) {
    int within = 0, all = 0;
    for (int trial = 0; trial < 300; ++trial) {
      std::vector<double> off(5);
      for (double& by : off) by = noise(random);
      const auto line = line_through(along_edge(1, slope, off));
      if (!line) continue;
      ++all, within += std::abs(line->foot - 1) < 2 * line->deviation;
    }
    INFO("slope " << slope);
    CHECK(all > 270);
    CHECK(within > 0.93 * all);
  }
}
