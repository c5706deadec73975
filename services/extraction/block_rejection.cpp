#include "services/extraction/block_rejection.hpp"

#include <algorithm>
#include <cstring>

#include "services/extraction/instruction_sets.hpp"

namespace arcstart {
namespace {

constexpr int kLines = BlockRejection::kHeight / 2;  // of a row of blocks, smoothed down the image
constexpr int kBefore = 16,
              kAfter = 32;  // room at the ends of a line: mirrored values, whole loads

// Smooths down the image, x 16.
struct Smoothing {
  const std::uint8_t* rows[5];  // v-2 .. v+2
  int width;
  std::uint16_t* line;
};

template <int>
ARCSTART_INLINE_BODY void smooth_down_body(const Smoothing& smoothing) {
  const auto [a, b, c, d, e] = smoothing.rows;
  std::uint16_t* __restrict line = smoothing.line;
  for (int u = 0; u < smoothing.width; ++u)
    line[u] = static_cast<std::uint16_t>(a[u] + e[u] + 4 * (b[u] + d[u]) + 6 * c[u]);
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(smooth_down, (const Smoothing& smoothing), (smoothing))

// A row of blocks.
struct Folding {
  const std::uint16_t* lines;
  int line_stride, line_count, columns;
  const std::uint8_t* greys;
  std::ptrdiff_t stride;
  int width, rows;
  std::uint16_t *lowest, *highest, *plain_lowest, *plain_highest;  // of each block
  std::uint16_t* smoothed;  // the first line, smoothed along as well
  std::ptrdiff_t smoothed_stride;
};

typedef std::uint32_t Pairs __attribute__((vector_size(32)));     // of columns, the even one low
typedef std::uint16_t Smoothed __attribute__((vector_size(16)));  // of every second column
typedef std::uint8_t Greys __attribute__((vector_size(16)));
static_assert(sizeof(Pairs) == BlockRejection::kWidth * sizeof(std::uint16_t));
static_assert(sizeof(Greys) == BlockRejection::kWidth);

template <class Vector, class Element>
ARCSTART_INLINE_BODY Vector load_as(const Element* from) {
  Vector vector;
  std::memcpy(&vector, from, sizeof vector);
  return vector;
}

template <class Vector>
ARCSTART_INLINE_BODY Vector lower_of(Vector a, Vector b) {
  return a < b ? a : b;
}

// Lowest and highest lane. The highest as the lowest of its complement: halves of one register.
ARCSTART_INLINE_BODY void fold_lanes(Pairs low, Pairs high, std::uint16_t& lowest,
                                     std::uint16_t& highest) {
  const Pairs swapped{4, 5, 6, 7, 0, 1, 2, 3};
  low = lower_of(low, __builtin_shuffle(low, swapped));
  high = lower_of(~high, __builtin_shuffle(~high, swapped));
  Pairs both = __builtin_shuffle(low, high, Pairs{0, 1, 2, 3, 8, 9, 10, 11});
  both = lower_of(both, __builtin_shuffle(both, Pairs{2, 3, 0, 1, 6, 7, 4, 5}));
  both = lower_of(both, __builtin_shuffle(both, Pairs{1, 0, 3, 2, 5, 4, 7, 6}));
  lowest = static_cast<std::uint16_t>(both[0]);
  highest = static_cast<std::uint16_t>(~both[4]);
}

ARCSTART_INLINE_BODY void fold_lanes(Greys low, Greys high, std::uint16_t& lowest,
                                     std::uint16_t& highest) {
  const Greys swapped{8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7};
  low = lower_of(low, __builtin_shuffle(low, swapped));
  high = lower_of(~high, __builtin_shuffle(~high, swapped));
  Greys both =
      __builtin_shuffle(low, high, Greys{0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23});
  for (const Greys& order : {Greys{4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11},
                             Greys{2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13},
                             Greys{1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14}})
    both = lower_of(both, __builtin_shuffle(both, order));
  lowest = both[0];
  highest = static_cast<std::uint8_t>(~both[8]);
}

// Smooths the lines along, x 256 in all (exact in 16 bits: 255 * 256 < 65536), in the even columns,
// keeps them, and folds what a block holds of them; then the plain grey values.
template <int>
ARCSTART_INLINE_BODY void fold_blocks_body(const Folding& folding) {
  for (int column = 0; column < folding.columns; ++column) {
    Pairs low = Pairs{} + 0xffffffffu, high{};
    for (int i = 0; i < folding.line_count; ++i) {
      const std::uint16_t* line =
          folding.lines + i * folding.line_stride + column * BlockRejection::kWidth;
      const Pairs left = load_as<Pairs>(line - 2), here = load_as<Pairs>(line),
                  right = load_as<Pairs>(line + 2);
      const Pairs odd = (left >> 16) + (here >> 16);
      const Pairs even = here & 0xffffu;
      const Pairs grey = (left & 0xffffu) + (right & 0xffffu) + ((odd + even) << 2) + (even << 1);
      low = grey < low ? grey : low;
      high = grey > high ? grey : high;
      const Smoothed smoothed = __builtin_convertvector(grey, Smoothed);
      std::memcpy(folding.smoothed + i * folding.smoothed_stride + column * sizeof(Smoothed) / 2,
                  &smoothed, sizeof smoothed);
    }
    fold_lanes(low, high, folding.lowest[column], folding.highest[column]);
  }
  const int whole = folding.width / BlockRejection::kWidth;
  for (int column = 0; column < whole; ++column) {
    const std::uint8_t* greys = folding.greys + column * BlockRejection::kWidth;
    Greys low = load_as<Greys>(greys), high = low;
    for (int v = 1; v < folding.rows; ++v) {
      const Greys grey = load_as<Greys>(greys + v * folding.stride);
      low = grey < low ? grey : low;
      high = grey > high ? grey : high;
    }
    fold_lanes(low, high, folding.plain_lowest[column], folding.plain_highest[column]);
  }
  if (whole == folding.columns) return;
  std::uint8_t low = 255, high = 0;
  for (int v = 0; v < folding.rows; ++v)
    for (int u = whole * BlockRejection::kWidth; u < folding.width; ++u) {
      low = std::min(low, folding.greys[v * folding.stride + u]);
      high = std::max(high, folding.greys[v * folding.stride + u]);
    }
  folding.plain_lowest[whole] = low;
  folding.plain_highest[whole] = high;
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(fold_blocks, (const Folding& folding), (folding))

}  // namespace

// Into line number `line`, mirrored at its ends. Behind the image the last values are repeated, so
// that they add nothing to the last block.
void BlockRejection::smooth_row(const GreyImage& image, int v, int line) {
  const int stride = kBefore + columns_ * kWidth + kAfter;
  std::uint16_t* values = lines_.data() + line * stride + kBefore;
  Smoothing smoothing{{}, image.width, values};
  for (int k = -2; k <= 2; ++k) smoothing.rows[k + 2] = image.row(reflect_101(v + k, image.height));
  smooth_down(smoothing);
  values[-1] = values[reflect_101(-1, image.width)];
  values[-2] = values[reflect_101(-2, image.width)];
  // The last two of a line mirrored; from there on as many again, forth and back.
  for (int u = image.width; u < columns_ * kWidth + 2; ++u)
    values[u] = values[reflect_101(u, image.width)];
}

void BlockRejection::fold_ranges(const GreyImage& image) {
  columns_ = (image.width + kWidth - 1) / kWidth;
  rows_ = (image.height + kHeight - 1) / kHeight;
  const std::size_t blocks = static_cast<std::size_t>(columns_) * rows_;
  for (Ranges* ranges : {&smoothed_, &plain_}) {
    ranges->lowest.resize(blocks);
    ranges->highest.resize(blocks);
  }
  const int line_stride = kBefore + columns_ * kWidth + kAfter;
  lines_.resize(static_cast<std::size_t>(kLines) * line_stride);
  differences_.resize(image.width, image.height, columns_);
  for (int row = 0; row < rows_; ++row) {
    const int begin = row * kHeight, end = std::min(begin + kHeight, image.height);
    int lines = 0;
    for (int v = begin; v < end; v += 2) smooth_row(image, v, lines++);
    const std::size_t at = static_cast<std::size_t>(row) * columns_;
    fold_blocks({lines_.data() + kBefore, line_stride, lines, columns_, image.row(begin),
                 image.stride, image.width, end - begin, &smoothed_.lowest[at],
                 &smoothed_.highest[at], &plain_.lowest[at], &plain_.highest[at],
                 differences_.row(row * kLines), differences_.stride()});
  }
}

namespace {

struct Spreading {
  std::uint16_t* values;
  std::uint16_t* work;
  int columns, rows, reach_columns, reach_rows;
};

template <class Better>
ARCSTART_INLINE_BODY void spread(const Spreading& s, Better better) {
  for (int row = 0; row < s.rows; ++row) {
    const std::uint16_t* from = s.values + static_cast<std::ptrdiff_t>(row) * s.columns;
    std::uint16_t* __restrict to = s.work + static_cast<std::ptrdiff_t>(row) * s.columns;
    std::copy(from, from + s.columns, to);
    for (int c = 1; c <= s.reach_columns; ++c) {
      for (int column = 0; column + c < s.columns; ++column)
        to[column] = better(to[column], from[column + c]);
      for (int column = c; column < s.columns; ++column)
        to[column] = better(to[column], from[column - c]);
    }
  }
  for (int row = 0; row < s.rows; ++row) {
    std::uint16_t* __restrict to = s.values + static_cast<std::ptrdiff_t>(row) * s.columns;
    const int begin = std::max(0, row - s.reach_rows),
              end = std::min(s.rows, row + s.reach_rows + 1);
    std::copy_n(s.work + static_cast<std::ptrdiff_t>(begin) * s.columns, s.columns, to);
    for (int r = begin + 1; r < end; ++r) {
      const std::uint16_t* from = s.work + static_cast<std::ptrdiff_t>(r) * s.columns;
      for (int column = 0; column < s.columns; ++column)
        to[column] = better(to[column], from[column]);
    }
  }
}

template <int>
ARCSTART_INLINE_BODY void spread_lowest_body(const Spreading& s) {
  spread(s, [](std::uint16_t a, std::uint16_t b) { return b < a ? b : a; });
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(spread_lowest, (const Spreading& s), (s))
template <int>
ARCSTART_INLINE_BODY void spread_highest_body(const Spreading& s) {
  spread(s, [](std::uint16_t a, std::uint16_t b) { return b > a ? b : a; });
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(spread_highest, (const Spreading& s), (s))

}  // namespace

void BlockRejection::Ranges::widen(int columns, int rows, int reach_columns, int reach_rows,
                                   std::vector<std::uint16_t>& work) {
  work.resize(lowest.size());
  spread_lowest({lowest.data(), work.data(), columns, rows, reach_columns, reach_rows});
  spread_highest({highest.data(), work.data(), columns, rows, reach_columns, reach_rows});
}

void BlockRejection::mark(const GreyImage& image, const GaussianKernels& kernels,
                          double least_curvature) {
  if (kernels.sigma != bound_sigma_) {
    bound_ = curvature_bound(kernels);
    bend_ = bend_bound(kernels, kHeight * ((3 * kernels.half_width / 4 + kHeight - 1) / kHeight));
    bound_sigma_ = kernels.sigma;
  }
  fold_ranges(image);
  const auto widen = [&](Ranges& ranges, int reach) {
    ranges.widen(columns_, rows_, (reach + kWidth - 1) / kWidth, (reach + kHeight - 1) / kHeight,
                 work_);
  };
  widen(smoothed_, bound_.smoothed_reach);
  if (bend_.holds) {
    near_ = plain_;
    widen(near_, bend_.rest_reach);
  }
  widen(plain_, bound_.reach);
  // 1/64 grey value for the rounding of float sums.
  const auto least = static_cast<float>(least_curvature - bound_.per_smoothed_grey / 64);
  mark_by_range(least);
  if (bend_.holds) leave_out_by_bend(least);
}

void BlockRejection::mark_by_range(float least_curvature) {
  active_.resize(smoothed_.lowest.size());
  const auto smoothed_share = static_cast<float>(bound_.per_smoothed_grey / 256),
             plain_share = static_cast<float>(bound_.per_grey);
  for (std::size_t block = 0; block < active_.size(); ++block) {
    const int smoothed_range = smoothed_.highest[block] - smoothed_.lowest[block];
    const int range = plain_.highest[block] - plain_.lowest[block];
    active_[block] = smoothed_share * static_cast<float>(smoothed_range) +
                         plain_share * static_cast<float>(range) >=
                     least_curvature;
  }
}

// Not where most of the image is left: then it is noise, which bends as much as it ranges.
void BlockRejection::leave_out_by_bend(float least_curvature) {
  const auto left = std::count(active_.begin(), active_.end(), 1);
  if (10 * left > 6 * static_cast<std::ptrdiff_t>(active_.size())) return;
  const int reach_columns = (bend_.reach + kWidth - 1) / kWidth,
            reach_rows = (bend_.reach + kHeight - 1) / kHeight;
  const auto around = [&](int column, int row, const auto& visit) {
    const int end_row = std::min(rows_, row + reach_rows + 1),
              end_column = std::min(columns_, column + reach_columns + 1);
    for (int r = std::max(0, row - reach_rows); r < end_row; ++r)
      for (int c = std::max(0, column - reach_columns); c < end_column; ++c)
        visit(r * columns_ + c);
  };
  const auto each_active = [&](const auto& visit) {
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column)
        if (active(column, row)) visit(column, row);
  };
  differences_.forget();
  each_active([&](int column, int row) {
    around(column, row, [&](int block) { differences_.want(block); });
  });
  differences_.find_highest();
  const auto share = static_cast<float>(bend_.per_grey), far = static_cast<float>(bend_.far);
  each_active([&](int column, int row) {
    float highest = 0;
    around(column, row,
           [&](int block) { highest = std::max(highest, differences_.highest(block)); });
    const int block = row * columns_ + column;
    const int range = near_.highest[block] - near_.lowest[block];
    active_[block] = highest + share * static_cast<float>(range) + far >= least_curvature;
  });
}

}  // namespace arcstart
