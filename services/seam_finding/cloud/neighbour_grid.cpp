#include "services/seam_finding/cloud/neighbour_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "services/seam_finding/cloud/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// std::floor is a call of a library where the processor is not known to have an instruction for it.
int floor_within_range(double value) {
  if (!(value >= -kCloud.cell_bias)) return -kCloud.cell_bias;  // also what is no number
  if (value >= kCloud.cell_bias - 1) return kCloud.cell_bias - 1;
  const int truncated = static_cast<int>(value);
  return truncated - (value < truncated);
}

std::size_t hash(std::uint64_t key) {
  key ^= key >> 31;
  key *= 0x9e3779b97f4a7c15ull;
  return static_cast<std::size_t>(key ^ (key >> 29));
}

}  // namespace

std::uint64_t NeighbourGrid::key_of(const Cell& cell) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
    key = key << 21 | static_cast<std::uint64_t>(
                          std::clamp(cell[axis] + kCloud.cell_bias, 0, 2 * kCloud.cell_bias - 1));
  return key;
}

NeighbourGrid::Cell NeighbourGrid::cell_of(const Eigen::Vector3d& point) const {
  Cell cell;
  for (int axis = 0; axis < 3; ++axis) cell[axis] = floor_within_range(point[axis] / cell_mm_);
  return cell;
}

NeighbourGrid::NeighbourGrid(const std::vector<Eigen::Vector3d>& points, double cell_mm)
    : points_(points), cell_mm_(cell_mm), order_(points.size()) {
  if (points.empty()) {
    begins_.assign(1, 0);
    return;
  }
  std::vector<Cell> cells;
  cells.reserve(points.size());
  for (const Eigen::Vector3d& point : points) cells.push_back(cell_of(point));
  Cell high = low_ = cells.front();
  for (const Cell& cell : cells) low_ = low_.cwiseMin(cell), high = high.cwiseMax(cell);
  size_ = high - low_ + Cell::Ones();
  std::vector<int> cell_of_point(points.size());
  if (size_.cast<double>().prod() <= kCloud.box_cells * static_cast<double>(points.size() + 64))
    sort_cells_in_box(cells, cell_of_point);
  else
    sort_cells(cells, cell_of_point);
  std::vector<int> next = begins_;
  for (std::size_t i = 0; i < points.size(); ++i)
    order_[next[cell_of_point[i]]++] = static_cast<int>(i);
}

void NeighbourGrid::sort_cells_in_box(const std::vector<Cell>& cells,
                                      std::vector<int>& cell_of_point) {
  box_.assign(static_cast<std::size_t>(size_.prod()), 0);
  for (std::size_t i = 0; i < cells.size(); ++i) ++box_[cell_of_point[i] = place_in_box(cells[i])];
  int place = 0;
  for (int x = 0; x < size_.x(); ++x)
    for (int y = 0; y < size_.y(); ++y)
      for (int z = 0; z < size_.z(); ++z, ++place) {
        const int count = box_[place];
        box_[place] = count > 0 ? cell_count() : -1;
        if (count == 0) continue;
        keys_.push_back(key_of(low_ + Cell(x, y, z)));
        begins_.push_back((begins_.empty() ? 0 : begins_.back()) + count);
      }
  begins_.insert(begins_.begin(), 0);
  for (int& cell : cell_of_point) cell = box_[cell];
}

// Points mostly come in the order of a stripe, many of one cell in a row: a cell is looked up once
// for a run of them. Sorted are the cells alone, the points then counted into them.
void NeighbourGrid::sort_cells(const std::vector<Cell>& cells, std::vector<int>& cell_of_point) {
  slots_.assign(kCloud.first_slots, -1);
  std::vector<int> counts;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::uint64_t key = key_of(cells[i]);
    if (i > 0 && key == keys_[cell_of_point[i - 1]]) {
      ++counts[cell_of_point[i] = cell_of_point[i - 1]];
      continue;
    }
    int& found = slots_[slot_of(key)];
    if (found < 0) {
      found = static_cast<int>(keys_.size());
      keys_.push_back(key);
      counts.push_back(0);
    }
    ++counts[cell_of_point[i] = found];
    if (2 * keys_.size() >= slots_.size()) grow_slots(2 * slots_.size());
  }
  std::vector<int> rising(keys_.size()), rank(keys_.size());
  for (std::size_t i = 0; i < rising.size(); ++i) rising[i] = static_cast<int>(i);
  std::sort(rising.begin(), rising.end(), [&](int a, int b) { return keys_[a] < keys_[b]; });
  std::vector<std::uint64_t> keys(keys_.size());
  begins_.assign(keys_.size() + 1, 0);
  for (std::size_t i = 0; i < rising.size(); ++i) {
    rank[rising[i]] = static_cast<int>(i);
    keys[i] = keys_[rising[i]];
    begins_[i + 1] = begins_[i] + counts[rising[i]];
  }
  keys_ = std::move(keys);
  grow_slots(slots_.size());
  for (int& cell : cell_of_point) cell = rank[cell];
}

void NeighbourGrid::grow_slots(std::size_t size) {
  slots_.assign(size, -1);
  for (std::size_t i = 0; i < keys_.size(); ++i) slots_[slot_of(keys_[i])] = static_cast<int>(i);
}

std::size_t NeighbourGrid::slot_of(std::uint64_t key) const {
  std::size_t slot = hash(key) & (slots_.size() - 1);
  while (slots_[slot] >= 0 && keys_[slots_[slot]] != key) slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

int NeighbourGrid::index_of(const Cell& cell) const {
  if (keys_.empty()) return -1;
  // A negative number is a very large one without sign.
  const auto x = static_cast<unsigned>(cell.x()) - static_cast<unsigned>(low_.x());
  const auto y = static_cast<unsigned>(cell.y()) - static_cast<unsigned>(low_.y());
  const auto z = static_cast<unsigned>(cell.z()) - static_cast<unsigned>(low_.z());
  const auto sx = static_cast<unsigned>(size_.x()), sy = static_cast<unsigned>(size_.y()),
             sz = static_cast<unsigned>(size_.z());
  if (x >= sx || y >= sy || z >= sz) return -1;
  return box_.empty() ? slots_[slot_of(key_of(cell))] : box_[(x * sy + y) * sz + z];
}

// Cells are in the order of x, y, z: those that touch one lie in nine columns, in each next to each
// other, and nine places move on through the list as the cell does.
NeighbourGrid::Adjacency NeighbourGrid::adjacency() const {
  Adjacency adjacency;
  adjacency.begins.reserve(keys_.size() + 1);
  adjacency.cells.reserve(9 * keys_.size());
  std::array<std::size_t, 9> places{};
  for (int i = 0; i < cell_count(); ++i) {
    adjacency.begins.push_back(static_cast<int>(adjacency.cells.size()));
    const Cell middle = cell(i);
    for (int column = 0; column < 9; ++column) {
      const int x = middle.x() + column / 3 - 1, y = middle.y() + column % 3 - 1;
      if (std::min(x, y) < -kCloud.cell_bias || std::max(x, y) >= kCloud.cell_bias) continue;
      const std::uint64_t first = key_of({x, y, std::max(middle.z() - 1, -kCloud.cell_bias)});
      const std::uint64_t last = key_of({x, y, middle.z() + 1});
      std::size_t& place = places[column];
      while (place < keys_.size() && keys_[place] < first) ++place;
      for (std::size_t j = place; j < keys_.size() && keys_[j] <= last; ++j)
        adjacency.cells.push_back(static_cast<int>(j));
    }
  }
  adjacency.begins.push_back(static_cast<int>(adjacency.cells.size()));
  return adjacency;
}

std::vector<int> NeighbourGrid::cells_of_points() const {
  std::vector<int> cells(order_.size());
  for (int i = 0; i < cell_count(); ++i)
    for (const int point : points_in(i)) cells[point] = i;
  return cells;
}

NeighbourGrid::Cell NeighbourGrid::cell(int index) const {
  const std::uint64_t key = keys_[index];
  const std::uint64_t mask = 2 * kCloud.cell_bias - 1;
  return {static_cast<int>(key >> 42 & mask) - kCloud.cell_bias,
          static_cast<int>(key >> 21 & mask) - kCloud.cell_bias,
          static_cast<int>(key & mask) - kCloud.cell_bias};
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
  std::vector<int> around;
  for_each_around(cell_of(points_[point]), [&](int cell) { around.push_back(cell); });
  nearest_distances(point, k, around, distances);
}

void NeighbourGrid::nearest_distances(int point, int k, std::span<const int> around,
                                      std::vector<double>& distances) const {
  distances.assign(static_cast<std::size_t>(k), INFINITY);  // squared, the nearest so far, rising
  const Eigen::Vector3d& centre = points_[point];
  for (const int cell : around) {
    const auto inside = points_in(cell);
    const std::size_t step = 1 + inside.size() / kCloud.crowd;
    for (std::size_t i = 0; i < inside.size(); i += step) {
      if (inside[i] == point) continue;
      const double squared = (points_[inside[i]] - centre).squaredNorm();
      if (!(squared < distances.back())) continue;
      std::size_t place = distances.size() - 1;
      for (; place > 0 && distances[place - 1] > squared; --place)
        distances[place] = distances[place - 1];
      distances[place] = squared;
    }
  }
  while (!distances.empty() && distances.back() == INFINITY) distances.pop_back();
  for (double& distance : distances) distance = std::sqrt(distance);
}

}  // namespace arcstart::seam_finding
