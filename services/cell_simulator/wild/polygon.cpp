#include "services/cell_simulator/wild/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace arcstart::cell_simulator {
namespace {

using Point = Eigen::Vector2d;

constexpr double chord_error_mm = 0.01;

double turn_of(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool in_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  return turn_of(a, b, p) >= 0 && turn_of(b, c, p) >= 0 && turn_of(c, a, p) >= 0;
}

bool cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  return turn_of(a, b, c) * turn_of(a, b, d) < 0 && turn_of(c, d, a) * turn_of(c, d, b) < 0;
}

// The ring with the hole let in by a bridge, there and back, from the hole's outermost corner to
// the nearest of the ring's that no edge parts it from.
std::vector<int> bridged(const std::vector<int>& ring, const std::vector<int>& hole,
                         const std::vector<Point>& corners) {
  const auto x_of = [&](int i) { return corners[i].x(); };
  const auto outermost =
      std::max_element(hole.begin(), hole.end(), [&](int a, int b) { return x_of(a) < x_of(b); });
  const Point& from = corners[*outermost];
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& to = corners[ring[i]];
    const double distance = (to - from).norm();
    if (distance >= least) continue;
    bool free = true;
    for (const auto* other : {&ring, &hole})
      for (std::size_t k = 0; free && k < other->size(); ++k)
        free = !cross(from, to, corners[(*other)[k]], corners[(*other)[(k + 1) % other->size()]]);
    if (free) least = distance, nearest = i;
  }
  std::vector<int> result(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(nearest) + 1);
  result.insert(result.end(), outermost, hole.end());
  result.insert(result.end(), hole.begin(), outermost + 1);
  result.insert(result.end(), ring.begin() + static_cast<std::ptrdiff_t>(nearest), ring.end());
  return result;
}

}  // namespace

double twice_area(const std::vector<Point>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += a.x() * b.y() - b.x() * a.y();
  }
  return sum;
}

std::vector<std::array<int, 3>> triangulate(const Rings& rings) {
  std::vector<Point> corners;
  std::vector<std::vector<int>> numbers;
  for (const auto& ring : rings) {
    numbers.emplace_back(ring.size());
    std::iota(numbers.back().begin(), numbers.back().end(), static_cast<int>(corners.size()));
    corners.insert(corners.end(), ring.begin(), ring.end());
  }
  std::vector<int> left = numbers.at(0);
  // Holes from the right to the left, so that a bridge never meets a hole that comes later.
  std::vector<std::vector<int>> holes(numbers.begin() + 1, numbers.end());
  const auto right_of = [&](const std::vector<int>& hole) {
    double most = -std::numeric_limits<double>::infinity();
    for (const int i : hole) most = std::max(most, corners[i].x());
    return most;
  };
  std::sort(holes.begin(), holes.end(),
            [&](const auto& a, const auto& b) { return right_of(a) > right_of(b); });
  for (const auto& hole : holes) left = bridged(left, hole, corners);

  std::vector<std::array<int, 3>> triangles;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    // The ear with the largest of its smallest turns would be best; the first does.
    std::size_t ear = n;
    for (std::size_t i = 0; i < n && ear == n; ++i) {
      const int ia = left[(i + n - 1) % n], ib = left[i], ic = left[(i + 1) % n];
      const Point &a = corners[ia], &b = corners[ib], &c = corners[ic];
      if (turn_of(a, b, c) <= 1e-12) continue;
      bool clear = true;
      for (const int k : left) {
        const Point& p = corners[k];
        if (k == ia || k == ib || k == ic || p == a || p == b || p == c) continue;
        if (in_triangle(p, a, b, c)) {
          clear = false;
          break;
        }
      }
      if (clear) ear = i;
    }
    if (ear == n) {  // only corners without area are left, or rounding: any of these does no harm
      ear = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < n; ++i) {
        const double turn = std::abs(
            turn_of(corners[left[(i + n - 1) % n]], corners[left[i]], corners[left[(i + 1) % n]]));
        if (turn < least) least = turn, ear = i;
      }
    }
    const std::array<int, 3> triangle{left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]};
    if (turn_of(corners[triangle[0]], corners[triangle[1]], corners[triangle[2]]) > 0)
      triangles.push_back(triangle);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  if (left.size() == 3) triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

std::vector<Point> arc(const Point& middle, double radius, double from, double to) {
  // Half the angle of a chord whose middle lies so far inside.
  const double half = std::acos(std::max(0.5, 1 - chord_error_mm / std::max(radius, 1e-6)));
  const int pieces = std::max(2, static_cast<int>(std::ceil(std::abs(to - from) / (2 * half))));
  std::vector<Point> points;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = from + (to - from) * i / pieces;
    points.push_back(middle + radius * Point(std::cos(angle), std::sin(angle)));
  }
  return points;
}

std::vector<Point> circle(const Point& middle, double radius) {
  std::vector<Point> points = arc(middle, radius, 0, 2 * std::numbers::pi);
  points.pop_back();
  return points;
}

}  // namespace arcstart::cell_simulator
