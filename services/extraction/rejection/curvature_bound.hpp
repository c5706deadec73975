// How large a second derivative can be at most, from the range of the grey values around.
#pragma once

#include "services/extraction/image/gaussian_kernels.hpp"

namespace arcstart::extraction {

// Let b be the image smoothed with the binomial [1 4 6 4 1]/16 in both directions, known in every
// second column and row only. K is the kernel of the second derivative along some direction, at a
// pixel that lies anyhow to those columns and rows; and K image = R b + E image, with any R of zero
// sum on the columns and rows known. Then K and E have zero sum as well, and
//     |K image| <= 1/2 |R|_1 range(b) + 1/2 |E|_1 range(image),
// the ranges being those of the grey values under R and E. R is the least-squares one; what that
// leaves is in E, whose norm is computed and not guessed. Smoothing first is what makes the range
// small where there is noise alone.
struct CurvatureBound {
  int smoothed_reach;        // half-width of R, px
  int reach;                 // half-width of K and E, px
  double per_smoothed_grey;  // 1/2 |R|_1, worst direction and place; 1 / px^2
  double per_grey;           // 1/2 |E|_1, likewise; 1 / px^2

  // No second derivative exceeds this, where the grey values in reach differ by no more; grey
  // values / px^2.
  double highest(double smoothed_range, double range) const {
    return per_smoothed_grey * smoothed_range + per_grey * range;
  }
};
CurvatureBound curvature_bound(const GaussianKernels& kernels);

}  // namespace arcstart::extraction
