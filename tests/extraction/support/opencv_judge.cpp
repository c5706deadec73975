#include "tests/extraction/support/opencv_judge.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "tests/extraction/support/plain_ridge.hpp"

namespace arcstart::extraction {
std::vector<JudgePoint> judge_ridge_points(const cv::Mat& grey, const GaussianKernels& kernels,
                                           double least_curvature, int margin) {
  const cv::Mat g0 = both_sides(kernels.smooth, false, CV_64F),
                g1 = both_sides(kernels.first, true, CV_64F),
                g2 = both_sides(kernels.second, false, CV_64F);
  cv::Mat ru, rv, ruu, ruv, rvv;
  const auto filter = [&](cv::Mat& response, const cv::Mat& along_u, const cv::Mat& along_v) {
    cv::sepFilter2D(grey, response, CV_64F, along_u, along_v, {-1, -1}, 0, cv::BORDER_REFLECT_101);
  };
  filter(ru, g1, g0);
  filter(rv, g0, g1);
  filter(ruu, g2, g0);
  filter(ruv, g1, g1);
  filter(rvv, g0, g2);

  std::vector<JudgePoint> points;
  for (int row = margin; row < grey.rows - margin; ++row)
    for (int column = margin; column < grey.cols - margin; ++column) {
      const double uu = ruu.at<double>(row, column), uv = ruv.at<double>(row, column),
                   vv = rvv.at<double>(row, column);
      const double trace = uu + vv;
      const double eigenvalue = 0.5 * (trace - std::sqrt((uu - vv) * (uu - vv) + 4 * uv * uv));
      if (-eigenvalue < least_curvature * (1 - 1e-3)) continue;
      if (trace > 1e-3 * std::abs(eigenvalue)) continue;
      // Its eigenvector, from the angle of the principal axes.
      const double angle = 0.5 * std::atan2(2 * uv, uu - vv) + 1.5707963267948966;
      const double nu = std::cos(angle), nv = std::sin(angle);
      const double t = -(ru.at<double>(row, column) * nu + rv.at<double>(row, column) * nv) /
                       (uu * nu * nu + 2 * uv * nu * nv + vv * nv * nv);
      const double offset = std::max(std::abs(t * nu), std::abs(t * nv));
      if (offset > 0.5 + 1e-3) continue;
      // Curved alike in all directions: the normal, and with it the offset, is a matter of
      // rounding.
      const double other = trace - eigenvalue;
      const bool in_doubt = std::abs(-eigenvalue / least_curvature - 1) < 1e-3 ||
                            std::abs(offset - 0.5) < 1e-3 || std::abs(trace) < 1e-3 * -eigenvalue ||
                            std::abs(other - eigenvalue) < 0.02 * -eigenvalue;
      points.push_back({column + t * nu, row + t * nv, -eigenvalue, column, row, in_doubt});
    }
  return points;
}

Verdict compare(const std::vector<JudgePoint>& judge, const std::vector<RidgePoint>& points) {
  std::map<std::pair<int, int>, const JudgePoint*> by_pixel;
  for (const JudgePoint& point : judge) by_pixel[{point.row, point.column}] = &point;
  Verdict verdict;
  for (const RidgePoint& point : points) {
    const auto found = by_pixel.find({point.row, point.column});
    if (found == by_pixel.end()) {
      ++verdict.extra;
      continue;
    }
    if (!found->second->in_doubt)
      verdict.largest_deviation =
          std::max(verdict.largest_deviation,
                   std::hypot(found->second->u - point.u, found->second->v - point.v));
    by_pixel.erase(found);
  }
  for (const auto& [pixel, point] : by_pixel) verdict.missing += !point->in_doubt;
  for (const JudgePoint& point : judge) verdict.judged += !point.in_doubt;
  return verdict;
}

}  // namespace arcstart::extraction
