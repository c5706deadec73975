// Points sorted into cubic cells, so that what lies near a place is found without looking at the
// rest.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace arcstart::seam_finding {

class NeighbourGrid {
 public:
  // The points must outlive the grid. Coordinates beyond +-1e6 cells share the outermost cells.
  NeighbourGrid(const std::vector<Eigen::Vector3d>& points, double cell_mm);

  using Cell = Eigen::Vector3i;
  Cell cell_of(const Eigen::Vector3d& point) const;

  // Indices of the points in a cell, rising; empty for none.
  std::span<const int> points_in(const Cell& cell) const;

  // All cells that hold points, in a fixed order.
  int cell_count() const { return static_cast<int>(keys_.size()); }
  Cell cell(int index) const;
  std::span<const int> points_in(int index) const;
  int index_of(const Cell& cell) const;  // -1 for an empty cell

  // Calls visit(index) for every occupied cell that touches this one, itself included.
  template <class Visit>
  void for_each_around(const Cell& middle, Visit visit) const {
    if (!box_.empty()) {
      const Cell from = (middle - Cell::Ones()).cwiseMax(low_) - low_;
      const Cell to = (middle + Cell::Ones()).cwiseMin(low_ + size_ - Cell::Ones()) - low_;
      for (int x = from.x(); x <= to.x(); ++x)
        for (int y = from.y(); y <= to.y(); ++y)
          for (int z = from.z(); z <= to.z(); ++z)
            if (const int i = box_[(x * size_.y() + y) * size_.z() + z]; i >= 0) visit(i);
      return;
    }
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (const int i = index_of(Cell(middle + Cell(x, y, z))); i >= 0) visit(i);
  }

  // For every cell the occupied cells that touch it, itself included, in the order of
  // for_each_around(): one list behind the other, that of cell i from begins[i] to begins[i + 1].
  struct Adjacency {
    std::vector<int> begins, cells;
    std::span<const int> of(int cell) const {
      const auto i = static_cast<std::size_t>(cell);
      return {cells.data() + begins[i], static_cast<std::size_t>(begins[i + 1] - begins[i])};
    }
  };
  Adjacency adjacency() const;

  // The cell of each point, as an index.
  std::vector<int> cells_of_points() const;

  // Distances to the k nearest other points within the cells around, rising; fewer where there are
  // fewer. Of a crowded cell only 256 points are looked at, evenly taken. around: those cells.
  void nearest_distances(int point, int k, std::vector<double>& distances) const;
  void nearest_distances(int point, int k, std::span<const int> around,
                         std::vector<double>& distances) const;

  double cell_size() const { return cell_mm_; }
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

 private:
  static std::uint64_t key_of(const Cell& cell);
  std::size_t slot_of(std::uint64_t key) const;  // where it is, or would be
  void grow_slots(std::size_t size);
  // Both set keys_ and begins_ from the points' cells, and each point's cell as an index.
  void sort_cells_in_box(const std::vector<Cell>& cells, std::vector<int>& cell_of_point);
  void sort_cells(const std::vector<Cell>& cells, std::vector<int>& cell_of_point);
  int place_in_box(const Cell& cell) const {
    const Cell place = cell - low_;
    return (place.x() * size_.y() + place.y()) * size_.z() + place.z();
  }
  const std::vector<Eigen::Vector3d>& points_;
  double cell_mm_;
  std::vector<int> order_;           // point indices, cell by cell
  std::vector<std::uint64_t> keys_;  // of the occupied cells, rising
  std::vector<int> begins_;          // of each cell in order_, and the end
  // Where their box is not much larger than what it holds: the index of every cell of it, -1 for
  // none. Else empty, and a hash table of indices into keys_, -1 for none.
  std::vector<int> box_, slots_;
  Cell low_ = Cell::Zero(), size_ = Cell::Zero();
};

}  // namespace arcstart::seam_finding
