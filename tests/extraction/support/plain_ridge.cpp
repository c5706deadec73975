#include "tests/extraction/support/plain_ridge.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace arcstart::extraction {

cv::Mat both_sides(const std::vector<double>& taps, bool odd, int depth) {
  const int half = static_cast<int>(taps.size()) - 1;
  cv::Mat kernel(1, 2 * half + 1, CV_64F), converted;
  for (int k = 0; k <= half; ++k) {
    kernel.at<double>(half + k) = taps[k];
    kernel.at<double>(half - k) = odd ? -taps[k] : taps[k];
  }
  kernel.convertTo(converted, depth);
  return converted;
}

void PlainRidgeDetector::detect(const cv::Mat& grey, const GaussianKernels& kernels,
                                double least_curvature, std::vector<RidgePoint>& points) {
  points.clear();
  const cv::Mat g0 = both_sides(kernels.smooth, false, CV_32F),
                g1 = both_sides(kernels.first, true, CV_32F),
                g2 = both_sides(kernels.second, false, CV_32F);
  const auto filter = [&](cv::Mat& response, const cv::Mat& along_u, const cv::Mat& along_v) {
    cv::sepFilter2D(grey, response, CV_32F, along_u, along_v, {-1, -1}, 0, cv::BORDER_REFLECT_101);
  };
  filter(u_, g1, g0);
  filter(v_, g0, g1);
  filter(uu_, g2, g0);
  filter(uv_, g1, g1);
  filter(vv_, g0, g2);

  const int margin = RidgeDetector::margin(kernels);
  const auto least = static_cast<float>(least_curvature);
  for (int row = margin; row < grey.rows - margin; ++row) {
    const float *ru = u_.ptr<float>(row), *rv = v_.ptr<float>(row), *ruu = uu_.ptr<float>(row),
                *ruv = uv_.ptr<float>(row), *rvv = vv_.ptr<float>(row);
    for (int column = margin; column < grey.cols - margin; ++column) {
      const float uu = ruu[column], uv = ruv[column], vv = rvv[column];
      const float half_trace = 0.5f * (uu + vv), half_difference = 0.5f * (uu - vv);
      if (half_trace > 0) continue;
      const float eigenvalue = half_trace - std::sqrt(half_difference * half_difference + uv * uv);
      if (eigenvalue > -least) continue;
      float nu = uv, nv = eigenvalue - uu;
      if (std::abs(eigenvalue - vv) > std::abs(nv)) {
        nu = eigenvalue - vv;
        nv = uv;
      }
      const float length = std::sqrt(nu * nu + nv * nv);
      if (length == 0) continue;
      nu /= length;
      nv /= length;
      const float t = -(ru[column] * nu + rv[column] * nv) / eigenvalue;
      if (std::abs(t * nu) > 0.5f || std::abs(t * nv) > 0.5f) continue;
      points.push_back({static_cast<float>(column) + t * nu, static_cast<float>(row) + t * nv, nu,
                        nv, -eigenvalue, column, row});
    }
  }
}

}  // namespace arcstart::extraction
