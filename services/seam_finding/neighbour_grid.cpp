#include "services/seam_finding/neighbour_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace arcstart {
namespace {

constexpr int kBias = 1 << 20;  // cells on either side of the origin; 21 bits an axis
constexpr std::size_t kCrowd = 256;

std::size_t hash(std::uint64_t key) {
  key ^= key >> 31;
  key *= 0x9e3779b97f4a7c15ull;
  return static_cast<std::size_t>(key ^ (key >> 29));
}

}  // namespace

std::uint64_t NeighbourGrid::key_of(const Cell& cell) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
    key = key << 21 | static_cast<std::uint64_t>(std::clamp(cell[axis] + kBias, 0, 2 * kBias - 1));
  return key;
}

NeighbourGrid::Cell NeighbourGrid::cell_of(const Eigen::Vector3d& point) const {
  Cell cell;
  for (int axis = 0; axis < 3; ++axis)
    cell[axis] =
        static_cast<int>(std::clamp<double>(std::floor(point[axis] / cell_mm_), -kBias, kBias - 1));
  return cell;
}

NeighbourGrid::NeighbourGrid(const std::vector<Eigen::Vector3d>& points, double cell_mm)
    : points_(points), cell_mm_(cell_mm), order_(points.size()) {
  std::vector<std::pair<std::uint64_t, int>> keyed(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    keyed[i] = {key_of(cell_of(points[i])), static_cast<int>(i)};
  std::sort(keyed.begin(), keyed.end());
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    if (i == 0 || keyed[i].first != keyed[i - 1].first) {
      keys_.push_back(keyed[i].first);
      begins_.push_back(static_cast<int>(i));
    }
    order_[i] = keyed[i].second;
  }
  begins_.push_back(static_cast<int>(keyed.size()));
  slots_.assign(std::bit_ceil(2 * keys_.size() + 1), -1);
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    std::size_t slot = hash(keys_[i]) & (slots_.size() - 1);
    while (slots_[slot] >= 0) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = static_cast<int>(i);
  }
}

int NeighbourGrid::index_of(const Cell& cell) const {
  const std::uint64_t key = key_of(cell);
  for (std::size_t slot = hash(key) & (slots_.size() - 1); slots_[slot] >= 0;
       slot = (slot + 1) & (slots_.size() - 1))
    if (keys_[slots_[slot]] == key) return slots_[slot];
  return -1;
}

NeighbourGrid::Cell NeighbourGrid::cell(int index) const {
  const std::uint64_t key = keys_[index];
  const std::uint64_t mask = 2 * kBias - 1;
  return {static_cast<int>(key >> 42 & mask) - kBias, static_cast<int>(key >> 21 & mask) - kBias,
          static_cast<int>(key & mask) - kBias};
}

std::span<const int> NeighbourGrid::points_in(int index) const {
  const auto i = static_cast<std::size_t>(index);
  return {order_.data() + begins_[i], static_cast<std::size_t>(begins_[i + 1] - begins_[i])};
}

std::span<const int> NeighbourGrid::points_in(const Cell& cell) const {
  const int index = index_of(cell);
  return index < 0 ? std::span<const int>{} : points_in(index);
}

void NeighbourGrid::nearest_distances(int point, int k, std::vector<double>& distances) const {
  distances.clear();
  const Eigen::Vector3d& centre = points_[point];
  for_each_around(cell_of(centre), [&](int cell) {
    const auto inside = points_in(cell);
    const std::size_t step = 1 + inside.size() / kCrowd;
    for (std::size_t i = 0; i < inside.size(); i += step)
      if (inside[i] != point) distances.push_back((points_[inside[i]] - centre).squaredNorm());
  });
  const std::size_t kept = std::min(distances.size(), static_cast<std::size_t>(k));
  std::partial_sort(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(kept),
                    distances.end());
  distances.resize(kept);
  for (double& distance : distances) distance = std::sqrt(distance);
}

}  // namespace arcstart
