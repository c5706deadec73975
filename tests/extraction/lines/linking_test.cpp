#include "services/extraction/lines/linking.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

RidgePoint point(double u, double v, double angle, double curvature = 1) {
  return {static_cast<float>(u),
          static_cast<float>(v),
          static_cast<float>(-std::sin(angle)),
          static_cast<float>(std::cos(angle)),
          static_cast<float>(curvature),
          static_cast<int>(std::lround(u)),
          static_cast<int>(std::lround(v))};
}

// Normals have no sense: turn some over.
std::vector<RidgePoint> in_raster_order(std::vector<RidgePoint> points) {
  std::sort(points.begin(), points.end(), [](const RidgePoint& a, const RidgePoint& b) {
    return std::pair(a.row, a.column) < std::pair(b.row, b.column);
  });
  for (std::size_t i = 0; i < points.size(); i += 3) {
    points[i].normal_u *= -1;
    points[i].normal_v *= -1;
  }
  return points;
}

std::vector<Chain> link(const std::vector<RidgePoint>& points, double strong = 0, int fewest = 10) {
  std::vector<Chain> chains;
  Linker().link(points, {strong, fewest}, chains);
  return chains;
}

void check_order(const std::vector<RidgePoint>& points, const Chain& chain) {
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const RidgePoint &a = points[chain[i - 1]], &b = points[chain[i]];
    REQUIRE(std::hypot(a.u - b.u, a.v - b.v) <= 3.01);
  }
}

}  // namespace

TEST_CASE("a straight line is one chain from end to end, at every angle") {
  const double angle = GENERATE(0.0, 0.3, 0.785398, 1.2, 1.5708, 2.0, 2.8);
  std::vector<RidgePoint> line;
  for (int i = 0; i < 200; ++i)
    line.push_back(
        point(300 + (i - 100) * std::cos(angle), 300 + (i - 100) * std::sin(angle), angle));
  const auto points = in_raster_order(line);
  const auto chains = link(points);
  REQUIRE(chains.size() == 1);
  CHECK(chains[0].size() == 200);
  check_order(points, chains[0]);
  const RidgePoint &a = points[chains[0].front()], &b = points[chains[0].back()];
  CHECK(std::hypot(a.u - b.u, a.v - b.v) == Approx(199).margin(0.01));
}

TEST_CASE("holes of a pixel or two are stepped over, a gap is not") {
  const int hole = GENERATE(1, 2, 3, 5, 70);
  std::vector<RidgePoint> line;
  for (int i = 0; i < 100; ++i) line.push_back(point(i < 50 ? i : i + hole, 20 + 0.1 * i, 0.1));
  const auto points = in_raster_order(line);
  const auto chains = link(points);
  CHECK(chains.size() == (hole <= 1 ? 1u : hole == 2 ? chains.size() : 2u));
  std::size_t all = 0;
  for (const Chain& chain : chains) all += chain.size();
  CHECK(all == 100);
}

TEST_CASE("a closed curve is one chain") {
  std::vector<RidgePoint> circle;
  for (int i = 0; i < 250; ++i) {
    const double a = 2 * std::numbers::pi * i / 250;
    circle.push_back(
        point(100 + 40 * std::cos(a), 90 + 40 * std::sin(a), a + std::numbers::pi / 2));
  }
  const auto points = in_raster_order(circle);
  const auto chains = link(points);
  REQUIRE(chains.size() == 1);
  CHECK(chains[0].size() == 250);
  check_order(points, chains[0]);
}

TEST_CASE("of two crossing lines no chain turns into the other") {
  std::vector<RidgePoint> lines;
  for (int i = 0; i < 101; ++i) {
    lines.push_back(point(i + 0.01, 50.2, 0));
    if (i != 50) lines.push_back(point(50.2, i + 0.01, std::numbers::pi / 2));
  }
  const auto points = in_raster_order(lines);
  for (const Chain& chain : link(points)) {
    int across = 0;
    for (const int i : chain) across += std::abs(points[i].normal_v) > 0.9;
    CHECK((across == 0 || across == static_cast<int>(chain.size())));
  }
}

TEST_CASE("a chain needs strong points and length") {
  std::vector<RidgePoint> line;
  for (int i = 0; i < 60; ++i) line.push_back(point(i, 10, 0, i >= 30 && i < 30 + 3 ? 2 : 1));
  const auto points = in_raster_order(line);
  CHECK(link(points, 1.9).size() == 1);  // three strong ones carry the weak
  CHECK(link(points, 1.9)[0].size() == 60);
  CHECK(link(points, 2.1).empty());
  CHECK(link(points, 1.9, 60).size() == 1);
  CHECK(link(points, 1.9, 61).empty());
  CHECK(link({}, 1).empty());
}

TEST_CASE("any points are linked once, in chains whose neighbours are near") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 60), angle(0, 3.14);
  std::vector<RidgePoint> some;
  for (int i = 0; i < 1500; ++i) some.push_back(point(place(random), place(random), angle(random)));
  const auto points = in_raster_order(some);
  std::vector<int> seen(points.size(), 0);
  for (const Chain& chain : link(points, 0, 3)) {
    check_order(points, chain);
    for (const int i : chain) REQUIRE(++seen[i] == 1);
  }
}

TEST_CASE("where there is no room for all chains the strongest are kept, in their order") {
  std::vector<RidgePoint> lines;
  const auto add = [&](double v, int length, double curvature) {
    for (int i = 0; i < length; ++i) lines.push_back(point(10 + i, v, 0, curvature));
  };
  add(10, 300, 1);  // its curvatures are 300 together
  add(30, 50, 4);   // 200
  add(50, 100, 1);  // 100
  add(70, 20, 20);  // 400
  const auto points = in_raster_order(lines);
  const auto kept = [&](int most_points) {
    std::vector<Chain> chains;
    Linker linker;
    linker.link(points, {0, 10, most_points}, chains);
    std::vector<int> rows;
    std::size_t all = 0;
    for (const Chain& chain : chains) {
      rows.push_back(points[chain.front()].row);
      all += chain.size();
    }
    CHECK(linker.left_out() == (all < points.size()));
    return rows;
  };
  CHECK(kept(470) == std::vector{10, 30, 50, 70});
  CHECK(kept(469) == std::vector{10, 30, 70});
  CHECK(kept(320) == std::vector{10, 70});
  CHECK(kept(319) == std::vector{30, 50, 70});  // the longest one finds no room
  CHECK(kept(19).empty());
}
