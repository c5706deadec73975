// The ridge detector as it is usually written with OpenCV: five cv::sepFilter2D over the whole
// image in single precision, then a loop over its pixels. What the fast one is measured against.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "services/extraction/image/gaussian_kernels.hpp"
#include "services/extraction/ridge/ridge.hpp"

namespace arcstart::extraction {

class PlainRidgeDetector {
 public:
  // As RidgeDetector::detect.
  void detect(const cv::Mat& grey, const GaussianKernels& kernels, double least_curvature,
              std::vector<RidgePoint>& points);

 private:
  cv::Mat u_, v_, uu_, uv_, vv_;
};

// Taps -half_width .. half_width as a row, for cv::sepFilter2D.
cv::Mat both_sides(const std::vector<double>& taps, bool odd, int depth);

}  // namespace arcstart::extraction
