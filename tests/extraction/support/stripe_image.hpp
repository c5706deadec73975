// Images of straight stripes in closed form, for tests that want to know every pixel.
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

#include "services/extraction/image/grey_image.hpp"

namespace arcstart::extraction {

inline GreyImage view_of(const cv::Mat& grey) {
  return {grey.data, grey.cols, grey.rows, static_cast<std::ptrdiff_t>(grey.step)};
}

// Light, of float, before it is exposed.
inline cv::Mat darkness(int width, int height, double background = 10) {
  return cv::Mat(height, width, CV_32F, cv::Scalar(background));
}

// Adds a stripe from (u0, v0) to (u1, v1), ending sharply there, with a Gaussian profile across; 5
// x 5 samples a pixel.
inline void add_stripe(cv::Mat& light, double u0, double v0, double u1, double v1, double amplitude,
                       double width) {
  const double length = std::hypot(u1 - u0, v1 - v0), tu = (u1 - u0) / length,
               tv = (v1 - v0) / length;
  for (int row = 0; row < light.rows; ++row)
    for (int column = 0; column < light.cols; ++column) {
      const double middle = (row - v0) * tu - (column - u0) * tv;
      if (std::abs(middle) > 6 * width + 1) continue;
      double sum = 0;
      for (int s = 0; s < 25; ++s) {
        const double u = column + (s % 5 - 2) / 5.0 - u0, v = row + (s / 5 - 2) / 5.0 - v0;
        const double along = u * tu + v * tv, across = v * tu - u * tv;
        if (along >= 0 && along <= length) sum += std::exp(-across * across / (2 * width * width));
      }
      light.at<float>(row, column) += static_cast<float>(amplitude * sum / 25);
    }
}

// White noise, then 8 bits.
inline cv::Mat expose(const cv::Mat& light, double noise, std::uint64_t seed = 1) {
  cv::Mat grains(light.size(), CV_32F), grey;
  cv::RNG random(seed);
  random.fill(grains, cv::RNG::NORMAL, 0, 1);
  cv::Mat noisy = light + noise * grains;
  noisy.convertTo(grey, CV_8U);
  return grey;
}

}  // namespace arcstart::extraction
