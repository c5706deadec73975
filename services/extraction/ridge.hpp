// Steger's ridge points: where the grey values across a bright line have their maximum (Eq. 2 and
// 3).
#pragma once

#include <cstdint>
#include <vector>

#include "services/extraction/block_rejection.hpp"
#include "services/extraction/gaussian_kernels.hpp"
#include "services/extraction/grey_image.hpp"

namespace arcstart {

struct RidgePoint {
  float u, v;                // px, pixel centres at integers
  float normal_u, normal_v;  // unit, across the line, of either sense
  float curvature;  // size of the second derivative across the line, > 0; grey values / px^2
  std::int32_t column, row;  // the pixel that holds it: |u - column| <= 1/2, |v - row| <= 1/2
};

// Factor from curvature to the ridge strength N of Eq. 3, sigma^exponent. A Gaussian stripe of
// amplitude A and width w has curvature A w / (w^2 + sigma^2)^(3/2); times sigma^(3/2) that is
// largest where sigma = w, there A / (2^(3/2) sqrt(w)), so that with 3/2 the best scale is the
// stripe's own. The position never depends on it.
double strength_factor(double sigma, double exponent);

class RidgeDetector {
 public:
  // Every pixel whose Hessian (greys smoothed with the kernels, mirrored at the border) has a
  // negative eigenvalue of at least least_curvature in size, no smaller than the other's, and whose
  // extremum along the eigenvector lies within half a pixel in u and in v. In raster order of the
  // pixels. Pixels nearer than margin(kernels) to the border are left out: there the mirror image
  // bends the line. Exact: blocks are skipped only where they cannot hold such a pixel. An image no
  // larger than the kernels has none.
  void detect(const GreyImage& image, const GaussianKernels& kernels, double least_curvature,
              std::vector<RidgePoint>& points);

  // At two sigma the mirrored half shifts a line by less than 0.02 px per px of sigma and unit of
  // slope.
  static int margin(const GaussianKernels& kernels);

  double active_share() const { return active_share_; }  // of the last image's blocks

 private:
  void collect_in_raster_order(int height, std::vector<RidgePoint>& points);

  BlockRejection rejection_;
  std::vector<float> work_;
  std::vector<RidgePoint> found_;  // strip by strip
  std::vector<int> row_begin_;
  double active_share_ = 0;
};

}  // namespace arcstart
