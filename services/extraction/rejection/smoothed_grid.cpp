#include "services/extraction/rejection/smoothed_grid.hpp"

#include <algorithm>
#include <bit>

#include "services/extraction/image/simd_vectors.hpp"

namespace arcstart::extraction {
namespace {

constexpr int kRows = SmoothedGrid::kRows;
constexpr int kReach = 2;                                               // of the binomial; px
constexpr int kRowsUnder = SmoothedGrid::kCellHeight + 2 * kReach - 1;  // a row of cells needs

// A row of cells.
struct Smoothing {
  const std::uint8_t* rows[kRowsUnder];  // from kReach above it on, mirrored where the image ends
  int width;                             // px
  int cell_columns;
  std::uint16_t *even, *odd;  // columns of a line, smoothed down the image, x 16
  std::ptrdiff_t line_stride;
  std::uint16_t* eighths;
  std::ptrdiff_t eighths_stride;
  std::uint16_t *highest, *lowest_lacks, *plain_highest, *plain_lowest_lacks;  // of each cell
};

// The highest of each eight bytes.
template <int kFloats>
ARCSTART_INLINE_BODY typename Register<kFloats>::Fours highest_of_eights(
    typename Register<kFloats>::Bytes bytes) {
  using Longs = typename Register<kFloats>::Longs;
  using Bytes = typename Register<kFloats>::Bytes;
  for (const int bits : {32, 16, 8}) bytes = higher_of(bytes, (Bytes)((Longs)bytes >> bits));
  return low_words<kFloats>((Longs)bytes & 0xff);
}

// A register full of columns down the row of cells.
template <int kFloats>
ARCSTART_INLINE_BODY void smooth_down(const Smoothing& s, const std::uint8_t* const* rows, int u) {
  using Bytes = typename Register<kFloats>::Bytes;
  using Values = Words<kFloats>;
  Values even[kRowsUnder], odd[kRowsUnder];  // columns
  Bytes highest{}, lowest_lacks{};
#pragma GCC unroll 16
  for (int k = 0; k < kRowsUnder; ++k) {
    static_assert(std::endian::native == std::endian::little);
    const auto pairs = load_as<Values>(rows[k] + u);  // the even column low
    even[k] = pairs & 0xff;
    odd[k] = pairs >> 8;
    if (k >= kReach && k < kReach + SmoothedGrid::kCellHeight) {
      highest = higher_of(highest, (Bytes)pairs);
      lowest_lacks = higher_of(lowest_lacks, ~(Bytes)pairs);
    }
    if (k < 2 * kReach || k % 2 != 0) continue;
    const auto smooth = [&](const Values* values) {
      const Values side = values[k - 3] + values[k - 1];
      return values[k - 4] + values[k] + 4 * (side + values[k - 2]) + 2 * values[k - 2];
    };
    const std::ptrdiff_t at = (k / 2 - kReach) * s.line_stride + u / 2;
    store(s.even + at, smooth(even));
    store(s.odd + at, smooth(odd));
  }
  store(s.plain_highest + u / 8, highest_of_eights<kFloats>(highest));
  store(s.plain_lowest_lacks + u / 8, highest_of_eights<kFloats>(lowest_lacks));
}

// Behind the image each row's last value is repeated, so that it adds nothing to the last cell.
template <int kFloats>
ARCSTART_INLINE_BODY void smooth_rest_down(const Smoothing& s, int begin) {
  constexpr int kBytes = 4 * kFloats;
  std::uint8_t rest[kRowsUnder][kBytes];
  const std::uint8_t* rows[kRowsUnder];
  for (int k = 0; k < kRowsUnder; ++k) {
    const std::uint8_t* row = s.rows[k];
    for (int u = 0; u < kBytes; ++u) rest[k][u] = row[std::min(begin + u, s.width - 1)];
    rows[k] = rest[k] - begin;
  }
  smooth_down<kFloats>(s, rows, begin);
}

std::uint16_t& column_of_line(const Smoothing& s, int line, int u) {
  std::uint16_t* columns = (u & 1) != 0 ? s.odd : s.even;
  return columns[line * s.line_stride + (u >> 1)];
}

// As far as the cells go, and two columns to either side.
void mirror_ends(const Smoothing& s) {
  const int end = s.cell_columns * SmoothedGrid::kCellWidth + 2;
  for (int line = 0; line < kRows; ++line) {
    for (const int u : {-2, -1})
      column_of_line(s, line, u) = column_of_line(s, line, reflect_101(u, s.width));
    for (int u = s.width; u < end; ++u)
      column_of_line(s, line, u) = column_of_line(s, line, reflect_101(u, s.width));
  }
}

// x 256 in all (exact in 16 bits: 255 * 256 < 65536), in the even columns.
template <int kFloats>
ARCSTART_INLINE_BODY void smooth_along(const Smoothing& s, int x) {
  using Values = Words<kFloats>;
  Values highest{}, lowest_lacks{};
  for (int i = 0; i < kRows; ++i) {
    const std::uint16_t *even = s.even + i * s.line_stride + x,
                        *odd = s.odd + i * s.line_stride + x;
    const auto here = load_as<Values>(even);
    const Values side = load_as<Values>(odd - 1) + load_as<Values>(odd) + here;
    const Values value =
        load_as<Values>(even - 1) + load_as<Values>(even + 1) + 4 * side + 2 * here;
    highest = higher_of(highest, value);
    lowest_lacks = higher_of(lowest_lacks, SmoothedGrid::kFull - value);
    store(s.eighths + i * s.eighths_stride + x, value >> 5);
  }
  store(s.highest + x / SmoothedGrid::kColumns, highest_of_fours<kFloats>(highest));
  store(s.lowest_lacks + x / SmoothedGrid::kColumns, highest_of_fours<kFloats>(lowest_lacks));
}

template <int kFloats>
ARCSTART_INLINE_BODY void smooth_row_of_cells_body(const Smoothing& s) {
  constexpr int kBytes = 4 * kFloats;
  int u = 0;
  for (; u + kBytes <= s.width; u += kBytes) smooth_down<kFloats>(s, s.rows, u);
  if (u < s.width) smooth_rest_down<kFloats>(s, u);
  mirror_ends(s);
  for (int x = 0; x < s.cell_columns * SmoothedGrid::kColumns; x += kBytes / 2)
    smooth_along<kFloats>(s, x);
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(smooth_row_of_cells, (const Smoothing& smoothing), (smoothing))

}  // namespace

void SmoothedGrid::resize(int cell_columns, int cell_rows) {
  for (CellRanges* ranges : {&smoothed_, &plain_})
    for (CellPlane* plane : {&ranges->highest, &ranges->lowest_lacks})
      plane->resize(cell_columns, cell_rows);
  stride_ = kBefore + cell_columns * kColumns + kAfter;
  eighths_.resize(static_cast<std::size_t>(cell_rows * kRows) * stride_);
  lines_.resize(static_cast<std::size_t>(2 * kRows) * stride_);
}

void SmoothedGrid::smooth(const GreyImage& image, int first_cell_row) {
  for (int row = 0; row < cell_rows(); ++row) {
    Smoothing s{};
    for (int k = 0; k < kRowsUnder; ++k)
      s.rows[k] =
          image.row(reflect_101((first_cell_row + row) * kCellHeight + k - kReach, image.height));
    s.width = image.width;
    s.cell_columns = cell_columns();
    s.even = lines_.data() + kBefore;
    s.odd = s.even + kRows * stride_;
    s.line_stride = stride_;
    s.eighths = eighths_.data() + row * kRows * stride_ + kBefore;
    s.eighths_stride = stride_;
    s.highest = smoothed_.highest.row(row);
    s.lowest_lacks = smoothed_.lowest_lacks.row(row);
    s.plain_highest = plain_.highest.row(row);
    s.plain_lowest_lacks = plain_.lowest_lacks.row(row);
    smooth_row_of_cells(s);
    for (CellRanges* ranges : {&smoothed_, &plain_})
      for (CellPlane* plane : {&ranges->highest, &ranges->lowest_lacks}) plane->end_row(row);
    // Even places mirrored at a whole one are even places.
    const int end = cell_columns() * kColumns;
    for (int i = 0; i < kRows; ++i)
      for (const int x : {-2, -1, end, end + 1})
        s.eighths[i * stride_ + x] = s.eighths[i * stride_ + reflect_101(2 * x, image.width) / 2];
  }
}

}  // namespace arcstart::extraction
