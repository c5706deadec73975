#include "services/cell_simulator/wild/polygon.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "services/cell_simulator/base/random_stream.hpp"

namespace arcstart::cell_simulator {
namespace {

std::vector<Eigen::Vector2d> all(const Rings& rings) {
  std::vector<Eigen::Vector2d> corners;
  for (const auto& ring : rings) corners.insert(corners.end(), ring.begin(), ring.end());
  return corners;
}

int covering(const Rings& rings, const Eigen::Vector2d& p) {
  const auto corners = all(rings);
  int count = 0;
  for (const auto& [a, b, c] : triangulate(rings)) {
    const auto left = [&](int i, int j) {
      const Eigen::Vector2d way = corners[j] - corners[i], to = p - corners[i];
      return way.x() * to.y() - way.y() * to.x() > 0;
    };
    count += left(a, b) && left(b, c) && left(c, a);
  }
  return count;
}

double area(const Rings& rings) {
  const auto corners = all(rings);
  double sum = 0;
  for (const auto& [a, b, c] : triangulate(rings))
    sum += twice_area({corners[a], corners[b], corners[c]}) / 2;
  return sum;
}

}  // namespace

TEST_CASE("A polygon with a notch and two holes is covered once, its openings not at all") {
  std::vector<Eigen::Vector2d> outline{{0, 0},   {60, 0},  {60, 40}, {35, 40},
                                       {35, 25}, {25, 25}, {25, 40}, {0, 40}};
  std::vector<Eigen::Vector2d> left = circle({12, 20}, 6), right = circle({48, 14}, 8);
  const double circles = (twice_area(left) + twice_area(right)) / 2;
  std::reverse(left.begin(), left.end());
  std::reverse(right.begin(), right.end());
  const Rings rings{outline, left, right};
  CHECK(area(rings) == Approx(60 * 40 - 10 * 15 - circles).epsilon(1e-9));

  RandomStream random(5);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d p(random.uniform(-5, 65), random.uniform(-5, 45));
    const bool in_box = p.x() > 0 && p.x() < 60 && p.y() > 0 && p.y() < 40;
    const bool in_notch = p.x() > 25 && p.x() < 35 && p.y() > 25;
    const double to_left = (p - Eigen::Vector2d(12, 20)).norm() - 6,
                 to_right = (p - Eigen::Vector2d(48, 14)).norm() - 8;
    if (std::abs(to_left) < 0.02 || std::abs(to_right) < 0.02) continue;
    CHECK(covering(rings, p) == (in_box && !in_notch && to_left > 0 && to_right > 0 ? 1 : 0));
  }
}

TEST_CASE("A flame's cut is covered once") {
  std::vector<Eigen::Vector2d> outline{{0, 0}, {50, 0}};
  for (int i = 0; i <= 80; ++i) outline.emplace_back(50 + std::sin(i * 0.8), i * 0.5);
  outline.emplace_back(0, 40);
  CHECK(area({outline}) == Approx(twice_area(outline) / 2).epsilon(1e-9));
}

TEST_CASE("No chord of a circle lies farther inside than a hundredth of a millimetre") {
  for (const double radius : {0.5, 3.0, 15.0}) {
    const auto corners = circle({1, 2}, radius);
    const Eigen::Vector2d middle = (corners[0] + corners[1]) / 2;
    const double inside = radius - (middle - Eigen::Vector2d(1, 2)).norm();
    CHECK(inside > 0);
    CHECK(inside <= 0.01);
  }
}

}  // namespace arcstart::cell_simulator
