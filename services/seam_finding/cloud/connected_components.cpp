#include "services/seam_finding/cloud/connected_components.hpp"

#include <algorithm>

namespace arcstart::seam_finding {

Pieces::Pieces(const NeighbourGrid& grid)
    : adjacency_(grid.adjacency()),
      cells_(grid.cells_of_points()),
      counts_(static_cast<std::size_t>(grid.cell_count())),
      pieces_(counts_.size()) {}

void Pieces::join(std::span<const int> chosen) {
  held_.clear();
  for (const int point : chosen) {
    const int cell = cells_[point];
    if (counts_[cell]++ == 0) held_.push_back(cell), pieces_[cell] = -1;
  }
  largest_ = -1, size_ = 0;
  int pieces = 0, lowest_of_largest = 0;
  for (const int start : held_) {
    if (pieces_[start] >= 0) continue;
    int size = 0, lowest = start;
    pieces_[start] = pieces;
    open_.assign(1, start);
    while (!open_.empty()) {
      const int cell = open_.back();
      open_.pop_back();
      size += counts_[cell];
      lowest = std::min(lowest, cell);
      for (const int next : adjacency_.of(cell))
        if (counts_[next] > 0 && pieces_[next] < 0) pieces_[next] = pieces, open_.push_back(next);
    }
    // Of equals the first in the order of cells, whatever the order of the points.
    if (size > size_ || (size == size_ && lowest < lowest_of_largest))
      size_ = size, largest_ = pieces, lowest_of_largest = lowest;
    ++pieces;
  }
  for (const int cell : held_) counts_[cell] = 0;
}

int Pieces::largest_size(std::span<const int> chosen) {
  join(chosen);
  return size_;
}

void Pieces::keep_largest(std::vector<int>& chosen) {
  join(chosen);
  if (size_ == static_cast<int>(chosen.size())) return;
  std::erase_if(chosen, [&](int point) { return pieces_[cells_[point]] != largest_; });
}

}  // namespace arcstart::seam_finding
