#include "services/extraction/block_rejection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/extraction/instruction_sets.hpp"

namespace arcstart {
namespace {

// Taps -reach .. reach.
using Taps = std::vector<double>;

Taps both_sides(const std::vector<double>& taps, bool odd, int reach) {
  Taps all(2 * reach + 1, 0.0);
  for (int k = 0; k < static_cast<int>(taps.size()); ++k) {
    all[reach + k] = taps[k];
    all[reach - k] = odd ? -taps[k] : taps[k];
  }
  return all;
}

double norm(const Taps& taps) {
  double sum = 0;
  for (const double tap : taps) sum += std::abs(tap);
  return sum;
}

Taps binomial_of(const Taps& taps) {
  const int size = static_cast<int>(taps.size());
  Taps smoothed(taps.size(), 0.0);
  for (int i = 0; i < size; ++i)
    for (int k = -2; k <= 2; ++k)
      if (i + k >= 0 && i + k < size) {
        constexpr double kBinomial[] = {6.0 / 16, 4.0 / 16, 1.0 / 16};
        smoothed[i] += kBinomial[std::abs(k)] * taps[i + k];
      }
  return smoothed;
}

// r with binomial * r near taps, zero on the two outermost places so that its smoothing stays
// inside.
Taps undo_binomial(const Taps& taps) {
  Taps r = taps;
  for (int iteration = 0; iteration < 10; ++iteration) {
    const Taps smoothed = binomial_of(r);
    for (std::size_t i = 2; i + 2 < r.size(); ++i) r[i] += taps[i] - smoothed[i];
  }
  r[0] = r[1] = r[r.size() - 1] = r[r.size() - 2] = 0;
  return r;
}

struct Split {
  Taps whole, r, smoothed_r;
  double error;  // |whole - binomial * r|_1
};

Split split(const Taps& whole, const Taps& r) {
  Split parts{whole, r, binomial_of(r), 0};
  Taps rest = whole;
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= parts.smoothed_r[i];
  parts.error = norm(rest);
  return parts;
}

}  // namespace

CurvatureBound curvature_bound(const GaussianKernels& kernels) {
  const int reach = kernels.half_width + 4;
  const Taps smooth = both_sides(kernels.smooth, false, reach);
  const Taps first = both_sides(kernels.first, true, reach);
  const Taps second = both_sides(kernels.second, false, reach);
  Taps r0 = undo_binomial(smooth), r1 = undo_binomial(first), r2 = undo_binomial(second);
  double sum0 = 0, sum2 = 0;
  for (const double tap : r0) sum0 += tap;
  for (const double tap : r2) sum2 += tap;
  for (std::size_t i = 0; i < r2.size(); ++i)
    r2[i] -= sum2 / sum0 * r0[i];  // zero sum, as the bound needs
  const Split g0 = split(smooth, r0), g1 = split(first, r1), g2 = split(second, r2);

  // |R|_1 along the direction at angle a. By symmetry 0 .. 45 degrees are enough. Between two of
  // the angles the kernel differs from one on the chord, where the norm is convex, by 1 -
  // cos(pi/32) < 0.5 % at most.
  constexpr int kSteps = 8;
  double largest = 0;
  for (int step = 0; step <= kSteps; ++step) {
    const double angle = std::numbers::pi / 4 * step / kSteps;
    const double uu = std::cos(angle) * std::cos(angle), vv = std::sin(angle) * std::sin(angle);
    const double uv = 2 * std::cos(angle) * std::sin(angle);
    double sum = 0;
    for (std::size_t i = 0; i < r0.size(); ++i)
      for (std::size_t j = 0; j < r0.size(); ++j)
        sum += std::abs(uu * r2[i] * r0[j] + uv * r1[i] * r1[j] + vv * r0[i] * r2[j]);
    largest = std::max(largest, sum);
  }
  // K - b * R = e2 x g0 + (b r2) x e0 for the second derivatives along the axes, likewise for the
  // mixed one, whose weight 2 cos sin is at most 1.
  const double remainder = g2.error * norm(g0.whole) + norm(g2.smoothed_r) * g0.error +
                           g1.error * (norm(g1.whole) + norm(g1.smoothed_r));
  return {reach - 2, 0.5 * 1.005 * largest, 0.5 * remainder * 255};
}

namespace {

struct RowFold {
  const std::uint8_t* rows[5];  // v-2 .. v+2
  int width;
  std::uint16_t* line;  // width + 4
  std::uint16_t* lowest;
  std::uint16_t* highest;
};

// Smooths one row (x 256, exact in 16 bits: 255 * 256 < 65536) and folds it into the lowest and
// highest of its columns.
ARCSTART_INLINE_BODY void fold_row_body(const RowFold& fold) {
  const auto [a, b, c, d, e] = fold.rows;
  std::uint16_t* __restrict line = fold.line + 2;
  const int width = fold.width;
  for (int u = 0; u < width; ++u)
    line[u] = static_cast<std::uint16_t>(a[u] + e[u] + 4 * (b[u] + d[u]) + 6 * c[u]);
  line[-1] = line[reflect_101(-1, width)];
  line[-2] = line[reflect_101(-2, width)];
  line[width] = line[reflect_101(width, width)];
  line[width + 1] = line[reflect_101(width + 1, width)];
  std::uint16_t* __restrict lowest = fold.lowest;
  std::uint16_t* __restrict highest = fold.highest;
  for (int u = 0; u < width; ++u) {
    const auto grey = static_cast<std::uint16_t>(line[u - 2] + line[u + 2] +
                                                 4 * (line[u - 1] + line[u + 1]) + 6 * line[u]);
    lowest[u] = grey < lowest[u] ? grey : lowest[u];
    highest[u] = grey > highest[u] ? grey : highest[u];
  }
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(fold_row, (const RowFold& fold), (fold))

}  // namespace

void BlockRejection::fold_ranges(const GreyImage& image) {
  columns_ = (image.width + kWidth - 1) / kWidth;
  rows_ = (image.height + kHeight - 1) / kHeight;
  lowest_.assign(columns_ * rows_, 65535);
  highest_.assign(columns_ * rows_, 0);
  line_.resize(image.width + 4);
  for (int row = 0; row < rows_; ++row) {
    row_lowest_.assign(image.width, 65535);
    row_highest_.assign(image.width, 0);
    for (int v = row * kHeight; v < std::min((row + 1) * kHeight, image.height); ++v) {
      RowFold fold{{}, image.width, line_.data(), row_lowest_.data(), row_highest_.data()};
      for (int k = -2; k <= 2; ++k) fold.rows[k + 2] = image.row(reflect_101(v + k, image.height));
      fold_row(fold);
    }
    for (int u = 0; u < image.width; ++u) {
      const int block = row * columns_ + u / kWidth;
      lowest_[block] = std::min(lowest_[block], row_lowest_[u]);
      highest_[block] = std::max(highest_[block], row_highest_[u]);
    }
  }
}

void BlockRejection::widen(int reach_columns, int reach_rows) {
  widened_lowest_ = lowest_;
  widened_highest_ = highest_;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      for (int c = std::max(0, column - reach_columns);
           c <= std::min(columns_ - 1, column + reach_columns); ++c) {
        auto& low = widened_lowest_[row * columns_ + column];
        auto& high = widened_highest_[row * columns_ + column];
        low = std::min(low, lowest_[row * columns_ + c]);
        high = std::max(high, highest_[row * columns_ + c]);
      }
  lowest_ = widened_lowest_;
  highest_ = widened_highest_;
  for (int row = 0; row < rows_; ++row)
    for (int r = std::max(0, row - reach_rows); r <= std::min(rows_ - 1, row + reach_rows); ++r)
      for (int column = 0; column < columns_; ++column) {
        auto& low = widened_lowest_[row * columns_ + column];
        auto& high = widened_highest_[row * columns_ + column];
        low = std::min(low, lowest_[r * columns_ + column]);
        high = std::max(high, highest_[r * columns_ + column]);
      }
}

void BlockRejection::mark(const GreyImage& image, const GaussianKernels& kernels,
                          double least_curvature) {
  if (kernels.sigma != bound_sigma_) {
    bound_ = curvature_bound(kernels);
    bound_sigma_ = kernels.sigma;
  }
  fold_ranges(image);
  widen((bound_.reach + kWidth - 1) / kWidth, (bound_.reach + kHeight - 1) / kHeight);
  // 1/64 grey value for the rounding of float sums.
  const double least_range = 256 * (bound_.least_range(least_curvature) - 1.0 / 64);
  active_.resize(lowest_.size());
  for (std::size_t block = 0; block < active_.size(); ++block)
    active_[block] = widened_highest_[block] - widened_lowest_[block] >= least_range;
}

double BlockRejection::active_share() const {
  if (active_.empty()) return 0;
  return static_cast<double>(std::count(active_.begin(), active_.end(), 1)) / active_.size();
}

}  // namespace arcstart
