#include "services/extraction/rejection/block_rejection.hpp"

#include <algorithm>
#include <numeric>

#include "common/instruction_sets.hpp"

namespace arcstart::extraction {
namespace {

constexpr int kRowsOfBand = 24;

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
    const std::uint16_t bends =
        static_cast<float>(SecondDifferences::kUnit) * static_cast<float>(bend[i]) +
            near.share * static_cast<float>(a) >=
        least;
    passes[i] = passes[i] & bends;
  }
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(test_bends, (const BendTest& test), (test))

void widen(const CellRanges& ranges, int reach, CellPlane& work, CellRanges& widened) {
  const int reach_columns = cells(reach, SmoothedGrid::kCellWidth),
            reach_rows = cells(reach, SmoothedGrid::kCellHeight);
  ranges.highest.widen(1, reach_columns, reach_rows, work, widened.highest);
  ranges.lowest_lacks.widen(1, reach_columns, reach_rows, work, widened.lowest_lacks);
}

}  // namespace

void BlockRejection::mark(const GreyImage& image, const GaussianKernels& kernels,
                          double least_curvature, ThreadPool& pool) {
  if (kernels.sigma != bound_sigma_) {
    bound_ = curvature_bound(kernels);
    bend_bound_ = hessian_bound(kernels, kHeight * cells(3 * kernels.half_width / 4, kHeight));
    bound_sigma_ = kernels.sigma;
  }
  columns_ = cells(image.width, kWidth);
  rows_ = cells(image.height, kHeight);
  active_.resize(static_cast<std::size_t>(columns_) * rows_);
  bands_.resize(static_cast<std::size_t>(pool.size()));
  // 1/64 grey value for the rounding of float sums.
  const double least = least_curvature - bound_.per_smoothed_grey / 64;
  // The same bands for any number of threads.
  pool.run([&](int strip) {
    const StripRange share(cells(rows_, kRowsOfBand), strip, pool.size());
    for (int i = share.begin; i < share.end; ++i)
      mark_band(image, least, i * kRowsOfBand, bands_[static_cast<std::size_t>(strip)]);
  });
}

// Second differences take two of the grid's rows on either side.
int BlockRejection::rows_in_reach() const {
  const int of_ranges = cells(bound_.reach, kHeight);
  if (!bend_bound_.holds) return of_ranges;
  return std::max(
      {of_ranges, cells(bend_bound_.rest_reach, kHeight), cells(bend_bound_.reach, kHeight) + 1});
}

void BlockRejection::mark_band(const GreyImage& image, double least_curvature, int first_row,
                               Band& band) {
  const int reach = rows_in_reach();
  band.grid.resize(2 * columns_, kRowsOfBand + 2 * reach);
  band.grid.smooth(image, first_row - reach);
  mark_by_range(least_curvature, band);
  if (bend_bound_.holds) leave_out_by_bend(least_curvature, band);
  for (int row = first_row; row < std::min(first_row + kRowsOfBand, rows_); ++row) {
    const std::uint16_t* cell = band.cells.row(row - first_row + reach);
    for (int column = 0; column < columns_; ++column, cell += 2)
      active_[row * columns_ + column] = (cell[0] | cell[1]) != 0;
  }
}

void BlockRejection::mark_by_range(double least_curvature, Band& band) const {
  widen(band.grid.smoothed(), bound_.smoothed_reach, band.work, band.smoothed);
  widen(band.grid.plain(), bound_.reach, band.work, band.plain);
  band.cells.resize(band.grid.cell_columns(), band.grid.cell_rows());
  for (int row = 0; row < band.cells.rows(); ++row)
    test_ranges({{band.smoothed, row, bound_.per_smoothed_grey / 256},
                 {band.plain, row, bound_.per_grey},
                 static_cast<float>(least_curvature),
                 band.cells.columns(),
                 band.cells.row(row)});
}

// Not where most of the band is left: then it is noise, which bends as much as it ranges.
void BlockRejection::leave_out_by_bend(double least_curvature, Band& band) const {
  int left = 0;
  for (int row = 0; row < band.cells.rows(); ++row)
    left = std::accumulate(band.cells.row(row), band.cells.row(row) + band.cells.columns(), left);
  if (left == 0 || 10 * left > 9 * band.cells.columns() * band.cells.rows()) return;
  const int reach = bend_bound_.reach, reach_columns = cells(reach, SmoothedGrid::kCellWidth);
  band.cells.widen(1, reach_columns, cells(reach, kHeight), band.work, band.asked);
  band.bend.measure(band.grid, band.asked);
  band.bend.highest().widen(SmoothedGrid::kRows, reach_columns, cells(reach, 2), band.bend_work,
                            band.highest_bend);
  widen(band.grid.plain(), bend_bound_.rest_reach, band.work, band.near);
  for (int row = 0; row < band.cells.rows(); ++row)
    test_bends({band.highest_bend.row(row),
                {band.near, row, bend_bound_.per_grey},
                static_cast<float>(least_curvature - bend_bound_.far - SecondDifferences::kShort),
                band.cells.columns(),
                band.cells.row(row)});
}

}  // namespace arcstart::extraction
