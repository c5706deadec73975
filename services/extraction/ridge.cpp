#include "services/extraction/ridge.hpp"

#include <algorithm>
#include <cmath>

#include "services/extraction/ridge_tile.hpp"

namespace arcstart {
double strength_factor(double sigma, double exponent) { return std::pow(sigma, exponent); }

int RidgeDetector::margin(const GaussianKernels& kernels) {
  return static_cast<int>(std::ceil(2 * kernels.sigma));
}

void RidgeDetector::detect(const GreyImage& image, const GaussianKernels& kernels,
                           double least_curvature, std::vector<RidgePoint>& points) {
  points.clear();
  active_share_ = 0;
  const int border = margin(kernels);
  if (std::min(image.width, image.height) <= 2 * kernels.half_width + 1) return;
  rejection_.mark(image, kernels, least_curvature);
  active_share_ = rejection_.active_share();

  const std::vector<float> smooth(kernels.smooth.begin(), kernels.smooth.end());
  const std::vector<float> first(kernels.first.begin(), kernels.first.end());
  const std::vector<float> second(kernels.second.begin(), kernels.second.end());
  work_.resize(ridge_tile_work(kernels.half_width));
  found_.clear();

  constexpr int kBlocksAcross = kTileWidth / BlockRejection::kWidth;
  for (int column = 0; column < rejection_.columns(); column += kBlocksAcross) {
    const auto active = [&](int row) {
      for (int c = column; c < std::min(column + kBlocksAcross, rejection_.columns()); ++c)
        if (rejection_.active(c, row)) return true;
      return false;
    };
    for (int row = 0; row < rejection_.rows();) {
      if (!active(row)) {
        ++row;
        continue;
      }
      int end =
          row +
          1;  // one tile for as many active blocks as touch, so that its halo is filtered once
      while (end < rejection_.rows() && active(end)) ++end;
      const int first_row = std::max(row * BlockRejection::kHeight, border);
      const int end_row = std::min(end * BlockRejection::kHeight, image.height - border);
      if (first_row < end_row)
        find_ridge_points(
            {image, smooth.data(), first.data(), second.data(), kernels.half_width,
             static_cast<float>(least_curvature), column * BlockRejection::kWidth, first_row,
             end_row - first_row, border, image.width - 1 - border, work_.data()},
            found_);
      row = end;
    }
  }
  collect_in_raster_order(image.height, points);
}

// Strips come from left to right and each from top to bottom: a stable sort by row alone puts them
// in raster order.
void RidgeDetector::collect_in_raster_order(int height, std::vector<RidgePoint>& points) {
  row_begin_.assign(height + 1, 0);
  for (const RidgePoint& point : found_) ++row_begin_[point.row + 1];
  for (int row = 0; row < height; ++row) row_begin_[row + 1] += row_begin_[row];
  points.resize(found_.size());
  for (const RidgePoint& point : found_) points[row_begin_[point.row]++] = point;
}

}  // namespace arcstart
