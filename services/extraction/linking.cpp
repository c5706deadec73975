#include "services/extraction/linking.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart {
namespace {

// px: over a pixel or two in which rounding has lost the line, no farther.
constexpr int kReach = RidgeDetector::kLineReach;
constexpr float kLeastCosine = 0.8f;  // of the directions of neighbours: 37 degrees
constexpr float kTurnCost = 3.0f;     // px per unit of 1 - cosine

// What it costs to go on from p to q; side says on which side of p that is. Nothing below 0 is a
// neighbour.
float cost(const RidgePoint& p, const RidgePoint& q, int& side) {
  const float du = q.u - p.u, dv = q.v - p.v, distance_squared = du * du + dv * dv;
  if (distance_squared > kReach * kReach) return -1;
  const float cosine = std::abs(p.normal_u * q.normal_u + p.normal_v * q.normal_v);
  if (cosine < kLeastCosine) return -1;
  const float along = -du * p.normal_v + dv * p.normal_u;
  const float across = std::abs(du * p.normal_u + dv * p.normal_v);
  side = along > 0 ? 1 : 0;
  if (across > 0.3f + 0.7f * std::abs(along)) return -1;
  return std::sqrt(distance_squared) + kTurnCost * (1 - cosine);
}

}  // namespace

void Linker::find_neighbours(const std::vector<RidgePoint>& points) {
  best_.assign(points.size(), {-1, -1});
  if (points.empty()) return;
  const int first_row = points.front().row, rows = points.back().row - first_row + 1;
  row_begin_.assign(rows + 1, 0);
  for (const RidgePoint& point : points) ++row_begin_[point.row - first_row + 1];
  for (int row = 0; row < rows; ++row) row_begin_[row + 1] += row_begin_[row];

  std::array<int, 2 * kReach + 1>
      cursor{};  // first point of each row near that is not left of the reach
  int row = -1;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const RidgePoint& p = points[i];
    if (p.row - first_row != row) {
      row = p.row - first_row;
      for (int k = -kReach; k <= kReach; ++k)
        cursor[k + kReach] = row_begin_[std::clamp(row + k, 0, rows)];
    }
    std::array<float, 2> lowest{1e9f, 1e9f};
    for (int k = -kReach; k <= kReach; ++k) {
      if (row + k < 0 || row + k >= rows) continue;
      int& j = cursor[k + kReach];
      const int end = row_begin_[row + k + 1];
      while (j < end && points[j].column < p.column - kReach) ++j;
      for (int q = j; q < end && points[q].column <= p.column + kReach; ++q) {
        if (q == i) continue;
        int side = 0;
        const float price = cost(p, points[q], side);
        if (price < 0 || price >= lowest[side]) continue;
        lowest[side] = price;
        best_[i][side] = q;
      }
    }
  }
}

// Into followed_.
void Linker::follow(int start, int side, std::size_t size) {
  followed_.clear();
  int at = start, from_side = 1 - side;  // leave `at` by the side it was not entered from
  while (at >= 0 && !taken_[at] && followed_.size() < size) {
    taken_[at] = 1;
    followed_.push_back(at);
    const int next = linked_[at][1 - from_side];
    if (next < 0) break;
    from_side = linked_[next][0] == at ? 0 : 1;
    at = next;
  }
}

void Linker::link(const std::vector<RidgePoint>& points, const LinkingSettings& settings,
                  std::vector<Chain>& chains, Memory memory) {
  chains.clear();
  find_neighbours(points);
  const int count = static_cast<int>(points.size());
  linked_.assign(points.size(), {-1, -1});
  for (int i = 0; i < count; ++i)
    for (int side = 0; side < 2; ++side) {
      const int q = best_[i][side];
      if (q < 0) continue;
      int back = 0;
      cost(points[q], points[i], back);
      if (best_[q][back] == i) linked_[i][side] = q;
    }

  taken_.assign(points.size(), 0);
  const auto follow_and_keep = [&](int start, int side) {
    follow(start, side, points.size());
    if (static_cast<int>(followed_.size()) < settings.fewest_points) return;
    const auto strong = std::count_if(followed_.begin(), followed_.end(), [&](int i) {
      return points[i].curvature >= settings.strong_curvature;
    });
    if (strong >= 3) chains.emplace_back(followed_.begin(), followed_.end(), memory);
  };
  for (int i = 0; i < count; ++i)  // from each end; what is left then is closed
    if (!taken_[i] && (linked_[i][0] < 0 || linked_[i][1] < 0))
      follow_and_keep(i, linked_[i][1] >= 0 ? 1 : 0);
  for (int i = 0; i < count; ++i)
    if (!taken_[i]) follow_and_keep(i, 1);
}

}  // namespace arcstart
