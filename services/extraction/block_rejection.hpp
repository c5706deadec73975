// Finds the blocks of an image that cannot hold a ridge point, at a fraction of the cost of
// looking.
#pragma once

#include <cstdint>
#include <vector>

#include "services/extraction/bend_bound.hpp"
#include "services/extraction/curvature_bound.hpp"
#include "services/extraction/grey_image.hpp"
#include "services/extraction/second_differences.hpp"

namespace arcstart {

class BlockRejection {
 public:
  static constexpr int kWidth = 16, kHeight = 10;  // of a block, px

  // Marks the blocks that may hold a pixel that is bent down by least_curvature in some direction.
  // Image at least 3 x 3.
  void mark(const GreyImage& image, const GaussianKernels& kernels, double least_curvature);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool active(int column, int row) const { return active_[row * columns_ + column] != 0; }

 private:
  // Lowest and highest value of each block, then of each block and those in reach.
  struct Ranges {
    std::vector<std::uint16_t> lowest, highest;
    void widen(int columns, int rows, int reach_columns, int reach_rows,
               std::vector<std::uint16_t>& work);
  };
  void fold_ranges(const GreyImage& image);
  void smooth_row(const GreyImage& image, int v, int line);
  void mark_by_range(float least_curvature);
  void leave_out_by_bend(float least_curvature);

  int columns_ = 0, rows_ = 0;
  double bound_sigma_ = 0;
  CurvatureBound bound_{};
  BendBound bend_{};
  SecondDifferences differences_;
  Ranges smoothed_;  // grey values x 256, in every second column and row
  Ranges plain_;     // grey values
  Ranges near_;      // likewise, of fewer around
  std::vector<std::uint16_t> lines_, work_;
  std::vector<std::uint8_t> active_;
};

}  // namespace arcstart
