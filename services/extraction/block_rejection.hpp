// Finds the blocks of an image that cannot hold a ridge point, at a fraction of the cost of
// looking.
#pragma once

#include <cstdint>
#include <vector>

#include "services/extraction/gaussian_kernels.hpp"
#include "services/extraction/grey_image.hpp"

namespace arcstart {

// The bound. Let b be the binomial kernel [1 4 6 4 1]/16 in both directions, K the kernel of the
// second derivative along some direction, and K = b * R + E with any R of zero sum. Then K has zero
// sum as well, and so has E, and
//     |K image| <= 1/2 |R|_1 range(b image) + 1/2 |E|_1 range(image),
// the ranges being those of the grey values under R and E. R is found by undoing b approximately
// (van Cittert's iteration); what that leaves is in E, whose norm is computed and not guessed.
// Smoothing first is what makes the range small where there is noise alone.
struct CurvatureBound {
  int reach;                 // half-width of K, R and E, px
  double per_smoothed_grey;  // 1/2 |R|_1, worst direction; 1 / px^2
  double per_grey;           // 1/2 |E|_1, worst direction; 1 / px^2

  // No second derivative exceeds this, where the grey values in reach differ by no more; grey
  // values / px^2.
  double highest(double smoothed_range, double range) const {
    return per_smoothed_grey * smoothed_range + per_grey * range;
  }
};
CurvatureBound curvature_bound(const GaussianKernels& kernels);

class BlockRejection {
 public:
  static constexpr int kWidth = 16, kHeight = 10;  // of a block, px

  // Marks the blocks that may hold a second derivative of least_curvature. Image at least 3 x 3.
  void mark(const GreyImage& image, const GaussianKernels& kernels, double least_curvature);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool active(int column, int row) const { return active_[row * columns_ + column] != 0; }
  double active_share() const;

 private:
  // Lowest and highest value of each block, then of each block and those in reach.
  template <class Value>
  struct Ranges {
    std::vector<Value> lowest, highest;
    void widen(int columns, int rows, int reach_columns, int reach_rows, std::vector<Value>& work);
  };
  void fold_ranges(const GreyImage& image);

  int columns_ = 0, rows_ = 0;
  double bound_sigma_ = 0;
  CurvatureBound bound_{};
  Ranges<std::uint16_t> smoothed_;  // grey values x 256
  Ranges<std::uint8_t> plain_;
  std::vector<std::uint16_t> line_, line_lowest_, line_highest_, work16_;
  std::vector<std::uint8_t> plain_lowest_, plain_highest_, work8_;
  std::vector<std::uint8_t> active_;
};

}  // namespace arcstart
