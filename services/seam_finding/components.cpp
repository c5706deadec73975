#include "services/seam_finding/components.hpp"

#include <algorithm>

#include "services/seam_finding/neighbour_grid.hpp"

namespace arcstart {

std::vector<int> largest_component(const std::vector<Eigen::Vector3d>& points, double cell_mm) {
  const NeighbourGrid grid(points, cell_mm);
  std::vector<int> piece(grid.cell_count(), -1);  // of each cell
  std::vector<int> open;
  int largest = -1, pieces = 0;
  std::size_t most = 0;
  for (int start = 0; start < grid.cell_count(); ++start) {
    if (piece[start] >= 0) continue;
    std::size_t size = 0;
    piece[start] = pieces;
    open.assign(1, start);
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      size += grid.points_in(cell).size();
      grid.for_each_around(grid.cell(cell), [&](int next) {
        if (piece[next] < 0) piece[next] = pieces, open.push_back(next);
      });
    }
    if (size > most) most = size, largest = pieces;
    ++pieces;
  }
  std::vector<int> inside;
  for (int cell = 0; cell < grid.cell_count(); ++cell)
    if (piece[cell] == largest)
      for (const int point : grid.points_in(cell)) inside.push_back(point);
  std::sort(inside.begin(), inside.end());
  return inside;
}

}  // namespace arcstart
