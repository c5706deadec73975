// The plain form of the ridge detector, by five cv::sepFilter2D and cv::eigen's formulas in double
// precision: the judge.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "services/extraction/image/gaussian_kernels.hpp"
#include "services/extraction/ridge/ridge.hpp"

namespace arcstart::extraction {

struct JudgePoint {
  double u, v, curvature;
  int column, row;
  bool in_doubt;  // so near a limit that rounding may decide
};

// All pixels, margin and more from the border, that pass or nearly pass; nearly passing ones are
// in_doubt.
std::vector<JudgePoint> judge_ridge_points(const cv::Mat& grey, const GaussianKernels& kernels,
                                           double least_curvature, int margin);

struct Verdict {
  int judged = 0, missing = 0, extra = 0;
  double largest_deviation = 0;  // px
};
Verdict compare(const std::vector<JudgePoint>& judge, const std::vector<RidgePoint>& points);

}  // namespace arcstart::extraction
