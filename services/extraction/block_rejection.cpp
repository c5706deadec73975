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
  return {reach, 0.5 * 1.005 * largest, 0.5 * remainder};
}

namespace {

struct RowFold {
  const std::uint8_t* rows[5];  // v-2 .. v+2
  int width;
  std::uint16_t* line;  // width + 4
  std::uint16_t* lowest;
  std::uint16_t* highest;
  std::uint8_t* plain_lowest;
  std::uint8_t* plain_highest;
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
  std::uint8_t* __restrict plain_lowest = fold.plain_lowest;
  std::uint8_t* __restrict plain_highest = fold.plain_highest;
  for (int u = 0; u < width; ++u) {
    plain_lowest[u] = c[u] < plain_lowest[u] ? c[u] : plain_lowest[u];
    plain_highest[u] = c[u] > plain_highest[u] ? c[u] : plain_highest[u];
  }
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(fold_row, (const RowFold& fold), (fold))

}  // namespace

void BlockRejection::fold_ranges(const GreyImage& image) {
  columns_ = (image.width + kWidth - 1) / kWidth;
  rows_ = (image.height + kHeight - 1) / kHeight;
  const std::size_t blocks = static_cast<std::size_t>(columns_) * rows_;
  smoothed_.lowest.assign(blocks, 65535);
  smoothed_.highest.assign(blocks, 0);
  plain_.lowest.assign(blocks, 255);
  plain_.highest.assign(blocks, 0);
  line_.resize(image.width + 4);
  for (int row = 0; row < rows_; ++row) {
    line_lowest_.assign(image.width, 65535);
    line_highest_.assign(image.width, 0);
    plain_lowest_.assign(image.width, 255);
    plain_highest_.assign(image.width, 0);
    for (int v = row * kHeight; v < std::min((row + 1) * kHeight, image.height); ++v) {
      RowFold fold{{},
                   image.width,
                   line_.data(),
                   line_lowest_.data(),
                   line_highest_.data(),
                   plain_lowest_.data(),
                   plain_highest_.data()};
      for (int k = -2; k <= 2; ++k) fold.rows[k + 2] = image.row(reflect_101(v + k, image.height));
      fold_row(fold);
    }
    for (int u = 0; u < image.width; ++u) {
      const int block = row * columns_ + u / kWidth;
      smoothed_.lowest[block] = std::min(smoothed_.lowest[block], line_lowest_[u]);
      smoothed_.highest[block] = std::max(smoothed_.highest[block], line_highest_[u]);
      plain_.lowest[block] = std::min(plain_.lowest[block], plain_lowest_[u]);
      plain_.highest[block] = std::max(plain_.highest[block], plain_highest_[u]);
    }
  }
}

template <class Value>
void BlockRejection::Ranges<Value>::widen(int columns, int rows, int reach_columns, int reach_rows,
                                          std::vector<Value>& work) {
  const auto spread = [&](std::vector<Value>& values, auto better) {
    work = values;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        for (int c = std::max(0, column - reach_columns);
             c <= std::min(columns - 1, column + reach_columns); ++c)
          work[row * columns + column] =
              better(work[row * columns + column], values[row * columns + c]);
    values = work;
    for (int row = 0; row < rows; ++row)
      for (int r = std::max(0, row - reach_rows); r <= std::min(rows - 1, row + reach_rows); ++r)
        for (int column = 0; column < columns; ++column)
          values[row * columns + column] =
              better(values[row * columns + column], work[r * columns + column]);
  };
  spread(lowest, [](Value a, Value b) { return std::min(a, b); });
  spread(highest, [](Value a, Value b) { return std::max(a, b); });
}

void BlockRejection::mark(const GreyImage& image, const GaussianKernels& kernels,
                          double least_curvature) {
  if (kernels.sigma != bound_sigma_) {
    bound_ = curvature_bound(kernels);
    bound_sigma_ = kernels.sigma;
  }
  fold_ranges(image);
  const int reach_columns = (bound_.reach + kWidth - 1) / kWidth,
            reach_rows = (bound_.reach + kHeight - 1) / kHeight;
  smoothed_.widen(columns_, rows_, reach_columns, reach_rows, work16_);
  plain_.widen(columns_, rows_, reach_columns, reach_rows, work8_);
  active_.resize(smoothed_.lowest.size());
  for (std::size_t block = 0; block < active_.size(); ++block) {
    const double smoothed_range = (smoothed_.highest[block] - smoothed_.lowest[block]) / 256.0;
    const double range = plain_.highest[block] - plain_.lowest[block];
    // 1/64 grey value for the rounding of float sums.
    active_[block] = bound_.highest(smoothed_range + 1.0 / 64, range) >= least_curvature;
  }
}

double BlockRejection::active_share() const {
  if (active_.empty()) return 0;
  return static_cast<double>(std::count(active_.begin(), active_.end(), 1)) / active_.size();
}

}  // namespace arcstart
