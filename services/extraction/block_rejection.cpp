#include "services/extraction/block_rejection.hpp"

#include <numeric>

#include "services/extraction/instruction_sets.hpp"

namespace arcstart {
namespace {

int cells(int reach, int size) { return (reach + size - 1) / size; }

struct Range {
  const std::uint16_t *highest, *lowest_lacks;  // of a row of cells
  float share;                                  // curvature per unit of range

  Range(const CellRanges& ranges, int row, double curvature_per_unit)
      : highest(ranges.highest.row(row)),
        lowest_lacks(ranges.lowest_lacks.row(row)),
        share(static_cast<float>(curvature_per_unit)) {}
};

struct RangeTest {
  Range smoothed, plain;
  float least;
  int count;
  std::uint16_t* passes;  // 0 or 1
};

template <int>
ARCSTART_INLINE_BODY void test_ranges_body(const RangeTest& test) {
  const Range smoothed = test.smoothed, plain = test.plain;
  const float least = test.least + smoothed.share * SmoothedGrid::kFull + plain.share * 255;
  const int count = test.count;
  std::uint16_t* __restrict passes = test.passes;
  for (int i = 0; i < count; ++i) {
    const int a = smoothed.highest[i] + smoothed.lowest_lacks[i];
    const int b = plain.highest[i] + plain.lowest_lacks[i];
    passes[i] =
        smoothed.share * static_cast<float>(a) + plain.share * static_cast<float>(b) >= least;
  }
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(test_ranges, (const RangeTest& test), (test))

struct BendTest {
  const std::uint16_t* bend;
  Range near;
  float least;
  int count;
  std::uint16_t* passes;  // stays 1 or becomes 0
};

template <int>
ARCSTART_INLINE_BODY void test_bends_body(const BendTest& test) {
  const std::uint16_t* bend = test.bend;
  const Range near = test.near;
  const float least = test.least + near.share * 255;
  const int count = test.count;
  std::uint16_t* __restrict passes = test.passes;
  for (int i = 0; i < count; ++i) {
    const int a = near.highest[i] + near.lowest_lacks[i];
    const std::uint16_t bends = static_cast<float>(Bend::kUnit) * static_cast<float>(bend[i]) +
                                    near.share * static_cast<float>(a) >=
                                least;
    passes[i] = passes[i] & bends;
  }
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(test_bends, (const BendTest& test), (test))

}  // namespace

void BlockRejection::mark(const GreyImage& image, const GaussianKernels& kernels,
                          double least_curvature, ThreadPool& pool) {
  if (kernels.sigma != bound_sigma_) {
    bound_ = curvature_bound(kernels);
    bend_bound_ = bend_bound(kernels, kHeight * cells(3 * kernels.half_width / 4, kHeight));
    bound_sigma_ = kernels.sigma;
  }
  columns_ = cells(image.width, kWidth);
  rows_ = cells(image.height, kHeight);
  grid_.resize(image.width, image.height, 2 * columns_, pool.size());
  pool.run([&](int strip) {
    const StripRange rows(rows_, strip, pool.size());
    grid_.smooth(image, strip, rows.begin, rows.end);
  });
  // 1/64 grey value for the rounding of float sums.
  const double least = least_curvature - bound_.per_smoothed_grey / 64;
  mark_by_range(least);
  if (bend_bound_.holds) leave_out_by_bend(least, pool);
  active_.resize(static_cast<std::size_t>(columns_) * rows_);
  for (int row = 0; row < rows_; ++row) {
    const std::uint16_t* cells_of_row = cells_.row(row);
    for (int column = 0; column < columns_; ++column)
      active_[row * columns_ + column] =
          (cells_of_row[2 * column] | cells_of_row[2 * column + 1]) != 0;
  }
}

void BlockRejection::widen(const CellRanges& ranges, int reach, CellRanges& widened) {
  const int reach_columns = cells(reach, SmoothedGrid::kCellWidth),
            reach_rows = cells(reach, SmoothedGrid::kCellHeight);
  ranges.highest.widen(1, reach_columns, reach_rows, work_, widened.highest);
  ranges.lowest_lacks.widen(1, reach_columns, reach_rows, work_, widened.lowest_lacks);
}

void BlockRejection::mark_by_range(double least_curvature) {
  widen(grid_.smoothed(), bound_.smoothed_reach, smoothed_);
  widen(grid_.plain(), bound_.reach, plain_);
  cells_.resize(2 * columns_, rows_);
  for (int row = 0; row < rows_; ++row)
    test_ranges({{smoothed_, row, bound_.per_smoothed_grey / 256},
                 {plain_, row, bound_.per_grey},
                 static_cast<float>(least_curvature),
                 2 * columns_,
                 cells_.row(row)});
}

// Not where most of the image is left: then it is noise, which bends as much as it ranges.
void BlockRejection::leave_out_by_bend(double least_curvature, ThreadPool& pool) {
  int left = 0;
  for (int row = 0; row < rows_; ++row)
    left = std::accumulate(cells_.row(row), cells_.row(row) + 2 * columns_, left);
  if (10 * left > 6 * 2 * columns_ * rows_) return;
  const int reach = bend_bound_.reach;
  cells_.widen(1, cells(reach, SmoothedGrid::kCellWidth), cells(reach, SmoothedGrid::kCellHeight),
               work_, asked_);
  grid_.mirror();
  bend_.resize(grid_);
  pool.run([&](int strip) {
    const StripRange rows(rows_, strip, pool.size());
    bend_.measure(grid_, asked_, rows.begin, rows.end);
  });
  bend_.highest().widen(SmoothedGrid::kRows, cells(reach, SmoothedGrid::kCellWidth),
                        cells(reach, 2), bend_work_, highest_bend_);
  widen(grid_.plain(), bend_bound_.rest_reach, near_);
  for (int row = 0; row < rows_; ++row)
    test_bends({highest_bend_.row(row),
                {near_, row, bend_bound_.per_grey},
                static_cast<float>(least_curvature - bend_bound_.far - Bend::kShort),
                2 * columns_,
                cells_.row(row)});
}

}  // namespace arcstart
