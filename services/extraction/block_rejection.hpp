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
//     |K image| <= 1/2 |R|_1 range(b image) + 1/2 |E|_1 255,
// the range being that of the smoothed grey values under R. R is found by undoing b approximately
// (van Cittert's iteration); what that leaves is in E, whose norm is computed and not guessed.
// Smoothing first is what makes the range small where there is noise alone.
struct CurvatureBound {
  int reach;         // half-width of R, px
  double per_grey;   // 1/2 |R|_1, worst direction; 1 / px^2
  double remainder;  // 1/2 |E|_1 255, worst direction; grey values / px^2

  // Below this range of smoothed grey values no second derivative reaches the curvature; not above
  // 0 where nothing can be said.
  double least_range(double curvature) const { return (curvature - remainder) / per_grey; }
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
  void fold_ranges(const GreyImage& image);
  void widen(int reach_columns, int reach_rows);

  int columns_ = 0, rows_ = 0;
  double bound_sigma_ = 0;
  CurvatureBound bound_{};
  std::vector<std::uint16_t> lowest_, highest_, widened_lowest_,
      widened_highest_;  // smoothed greys x 256, a block
  std::vector<std::uint16_t> line_, row_lowest_, row_highest_;
  std::vector<std::uint8_t> active_;
};

}  // namespace arcstart
