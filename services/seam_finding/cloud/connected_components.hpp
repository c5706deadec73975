// Connected pieces of a set of points.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "services/seam_finding/cloud/neighbour_grid.hpp"

namespace arcstart::seam_finding {

// Connected pieces among choices of one cloud's points, whose cells are looked up once for all of
// them. Points belong together where their cells of a cubic grid touch, so gaps up to one cell
// never part them and gaps over two (three across corners) always do.
class Pieces {
 public:
  explicit Pieces(const NeighbourGrid& grid);  // of the cloud; not needed any more

  // How many of the chosen points, positions in the cloud, the largest piece holds.
  int largest_size(std::span<const int> chosen);
  // Keeps of the chosen ones the largest piece, in their order.
  void keep_largest(std::vector<int>& chosen);

 private:
  void join(std::span<const int> chosen);  // sets largest_, size_ and pieces_ of the cells chosen

  NeighbourGrid::Adjacency adjacency_;
  std::vector<int> cells_;   // of each point
  std::vector<int> counts_;  // of each cell, points chosen; 0 between calls
  std::vector<int> pieces_;  // of each cell that holds any
  std::vector<int> held_, open_;
  int largest_ = -1, size_ = 0;
};

}  // namespace arcstart::seam_finding
