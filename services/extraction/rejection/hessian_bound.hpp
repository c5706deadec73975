// How strong a ridge point can be at most, from second differences of the smoothed image around.
#pragma once

#include "services/extraction/image/gaussian_kernels.hpp"

namespace arcstart::extraction {

// Let b be the image smoothed with the binomial [1 4 6 4 1]/16 in both directions, known in every
// second column and row only, and x, y count those. Second differences of it,
//     xx = [1 0 -2 0 1]/16 along x of [1 1 1]/3 along y,   yy likewise,
//     xy = [-1 -4 0 4 1]/24 along x of [-1 -4 0 4 1]/24 along y,
// are second derivatives after one and the same smoothing, of variance 11/3 px^2 in all. What the
// kernels smooth more is a weighted mean of them, with weights H >= 0 of sum 1: at any pixel, and
// along any normal n, K image = H (n^T [xx xy; xy yy] n) + E image, where K is the kernel of the
// second derivative along n. So
//     -K image <= max over H of (max(-xx, -yy) + |xy|) + 1/2 |N|_1 range(image) + 255/2 |E - N|_1,
// the range being that of the grey values under N, which is E within a few px, its sum made nought
// as E's is.
struct HessianBound {
  bool holds = false;   // the kernels smooth enough for it
  int reach = 0;        // half-width of H, px
  int rest_reach = 0;   // half-width of N, px
  double per_grey = 0;  // 1/2 |N|_1, worst direction and place; 1 / px^2
  double far = 0;       // 255/2 |E - N|_1, likewise; grey values / px^2
};
// rest_reach: wanted.
HessianBound hessian_bound(const GaussianKernels& kernels, int rest_reach);

}  // namespace arcstart::extraction
