// The Gaussian and its first two derivatives, sampled for images (Eq. 2).
#pragma once

#include <vector>

namespace arcstart::extraction {

// Taps k = 0 .. half_width for correlation, response(x) = sum over k of tap[k] grey(x + k). Smooth
// and second are even in k, first is odd with its value for k > 0 given.
//
// A pixel is the mean of the light on its area, so a tap is the derivative integrated over a pixel:
// a difference of erf. Cut off at half_width >= 3.6 sigma they no longer differentiate exactly;
// renormalised they do again, on polynomials:
//     sum smooth = 1,  sum k first = 1,  sum second = 0,  sum k^2/2 second = 1.
struct GaussianKernels {
  double sigma = 0;  // px
  int half_width = 0;
  std::vector<double> smooth, first, second;
};

// sigma > 0.3 px.
GaussianKernels gaussian_kernels(double sigma);

}  // namespace arcstart::extraction
