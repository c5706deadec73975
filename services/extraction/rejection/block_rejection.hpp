// Finds the blocks of an image that cannot hold a ridge point, at a fraction of the cost of
// looking.
#pragma once

#include <cstdint>
#include <vector>

#include "services/extraction/image/grey_image.hpp"
#include "services/extraction/image/thread_pool.hpp"
#include "services/extraction/rejection/curvature_bound.hpp"
#include "services/extraction/rejection/hessian_bound.hpp"
#include "services/extraction/rejection/second_differences.hpp"
#include "services/extraction/rejection/smoothed_grid.hpp"

namespace arcstart::extraction {

class BlockRejection {
 public:
  // Of a block, px; it is two cells of the grid.
  static constexpr int kWidth = 2 * SmoothedGrid::kCellWidth, kHeight = SmoothedGrid::kCellHeight;

  // Marks the blocks that may hold a pixel that is bent down by least_curvature in some direction.
  // Image at least 3 x 3.
  void mark(const GreyImage& image, const GaussianKernels& kernels, double least_curvature,
            ThreadPool& pool);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool active(int column, int row) const { return active_[row * columns_ + column] != 0; }

 private:
  // What is known of a band of rows of cells and those in reach of them: little enough to stay in
  // the second-level cache.
  struct Band {
    SmoothedGrid grid;
    SecondDifferences bend;
    CellRanges smoothed, plain, near;  // of each cell and those in reach of it
    CellPlane highest_bend;            // likewise
    CellPlane cells, asked;            // 1: may hold such a pixel; its bend is asked for
    CellPlane work, bend_work;
  };
  void mark_band(const GreyImage& image, double least_curvature, int first_row, Band& band);
  void mark_by_range(double least_curvature, Band& band) const;
  void leave_out_by_bend(double least_curvature, Band& band) const;
  int rows_in_reach() const;

  int columns_ = 0, rows_ = 0;
  double bound_sigma_ = 0;
  CurvatureBound bound_{};
  HessianBound bend_bound_{};
  std::vector<Band> bands_;           // of each thread
  std::vector<std::uint8_t> active_;  // of each block
};

}  // namespace arcstart::extraction
