// By how much the smoothed image bends down at most, from its second differences.
#pragma once

#include "services/extraction/rejection/grid_max_filter.hpp"
#include "services/extraction/rejection/smoothed_grid.hpp"

namespace arcstart::extraction {

// Of max(-xx, -yy) + |xy| of hessian_bound.hpp, in each four columns of each row of the grid.
class SecondDifferences {
 public:
  static constexpr double kUnit = 1.0 / 576;  // grey values / px^2
  // By which whole numbers fall short at most: xx and yy take 6 values too many and 6 too few of
  // the eighths lost, of 384; xy 50 of 4608, and 5 of the 7/8 lost of first differences, of 576.
  static constexpr double kShort = 6.0 / 384 + 50.0 / 4608 + 5.0 * 7 / 8 / 576 + kUnit;

  // In the grid's cells that are asked for, and some others; 0 in its first and last row of cells.
  void measure(const SmoothedGrid& grid, const CellPlane& asked);
  const CellPlane& highest() const { return highest_; }  // in kUnit; 0 where it bends up

 private:
  CellPlane highest_;
};

}  // namespace arcstart::extraction
