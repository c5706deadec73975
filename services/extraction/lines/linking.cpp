#include "services/extraction/lines/linking.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcstart::extraction {
namespace {

// px: over a pixel or two in which rounding has lost the line, no farther.
constexpr int kReach = RidgeDetector::kLineReach;
constexpr float kLeastCosine = 0.8f;  // of the directions of neighbours: 37 degrees
constexpr float kTurnCost = 3.0f;     // px per unit of 1 - cosine

// What it costs to go on from p to q, or from q to p; below 0 where neither is the other's
// neighbour.
float cost(const RidgePoint& p, const RidgePoint& q) {
  const float du = q.u - p.u, dv = q.v - p.v, distance_squared = du * du + dv * dv;
  const float cosine = std::abs(p.normal_u * q.normal_u + p.normal_v * q.normal_v);
  if (distance_squared > kReach * kReach || cosine < kLeastCosine) return -1;
  return std::sqrt(distance_squared) + kTurnCost * (1 - cosine);
}

// On which side of p (du, dv) away is, if it is ahead on either; else -1.
int side_of(const RidgePoint& p, float du, float dv) {
  const float along = -du * p.normal_v + dv * p.normal_u;
  const float across = std::abs(du * p.normal_u + dv * p.normal_v);
  if (across > 0.3f + 0.7f * std::abs(along)) return -1;
  return along > 0 ? 1 : 0;
}

// False where there are no others.
bool keep_strongest(const std::vector<RidgePoint>& points, int most_points,
                    std::vector<Chain>& chains, Memory memory) {
  std::size_t all = 0, room = static_cast<std::size_t>(most_points);
  for (const Chain& chain : chains) all += chain.size();
  if (all <= room) return false;
  FrameVector<std::pair<double, std::size_t>> by_strength(memory);  // the strongest lowest
  for (std::size_t c = 0; c < chains.size(); ++c) {
    double sum = 0;
    for (const int i : chains[c]) sum += points[i].curvature;
    by_strength.push_back({-sum, c});
  }
  std::sort(by_strength.begin(), by_strength.end());
  FrameVector<char> kept(chains.size(), 0, memory);
  for (const auto& [strength, c] : by_strength)
    if (chains[c].size() <= room) {
      kept[c] = 1;
      room -= chains[c].size();
    }
  std::size_t next = 0;
  std::erase_if(chains, [&](const Chain&) { return kept[next++] == 0; });
  return true;
}

}  // namespace

// Each pair is looked at once. A point's neighbours come in raster order, of equally near ones the
// first is best.
void Linker::find_neighbours(const std::vector<RidgePoint>& points) {
  best_.assign(points.size(), {-1, -1});
  lowest_.assign(points.size(), {1e9f, 1e9f});
  if (points.empty()) return;
  const int first_row = points.front().row, rows = points.back().row - first_row + 1;
  row_begin_.assign(rows + 1, 0);
  for (const RidgePoint& point : points) ++row_begin_[point.row - first_row + 1];
  for (int row = 0; row < rows; ++row) row_begin_[row + 1] += row_begin_[row];

  const auto consider = [&](int i, int side, int q, float price) {
    if (side < 0 || price >= lowest_[i][side]) return;
    lowest_[i][side] = price;
    best_[i][side] = q;
  };
  // First point, of each row from the point's own on, that is not left of the reach.
  std::array<int, kReach + 1> cursor{};
  int row = -1;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const RidgePoint& p = points[i];
    if (p.row - first_row != row) {
      row = p.row - first_row;
      for (int k = 0; k <= kReach; ++k) cursor[k] = row_begin_[std::min(row + k, rows)];
    }
    cursor[0] = i + 1;
    for (int k = 0; k <= kReach && row + k < rows; ++k) {
      int& j = cursor[k];
      const int end = row_begin_[row + k + 1];
      while (j < end && points[j].column < p.column - kReach) ++j;
      for (int q = j; q < end && points[q].column <= p.column + kReach; ++q) {
        const float price = cost(p, points[q]);
        if (price < 0) continue;
        const float du = points[q].u - p.u, dv = points[q].v - p.v;
        consider(i, side_of(p, du, dv), q, price);
        consider(q, side_of(points[q], -du, -dv), i, price);
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
      if (best_[q][0] == i || best_[q][1] == i) linked_[i][side] = q;
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
  left_out_ = keep_strongest(points, settings.most_points, chains, memory);
}

}  // namespace arcstart::extraction
