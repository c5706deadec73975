// The usual ways to one centre a column, with OpenCV alone: what else is measured beside the ridge.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "tests/extraction/support/scene_score.hpp"

namespace arcstart::extraction {

// In each column, the brightest place of the image smoothed down the columns with sigma; where it
// stands out by 20 grey values from the image's median, a centre:
class ColumnMethods {
 public:
  // the centre of gravity of the grey values above half of that, within 4 sigma;
  void centroid(const cv::Mat& grey, double sigma, std::vector<Centre>& centres);
  // the vertex of the parabola through the logarithms of the grey values above a fifth, weighted
  // with the grey values' squares (least squares);
  void gaussian_fit(const cv::Mat& grey, double sigma, std::vector<Centre>& centres);
  // the zero crossing of the response to the Gaussian's first derivative, linearly between pixels.
  void finite_impulse(const cv::Mat& grey, double sigma, std::vector<Centre>& centres);

 private:
  void find_peaks(const cv::Mat& grey, double sigma);

  cv::Mat smooth_, slope_;
  std::vector<float> highest_;  // of each column
  std::vector<int> row_;        // where
  float background_ = 0;
};

}  // namespace arcstart::extraction
