#include "services/extraction/rejection/second_differences.hpp"

#include <cstring>

#include "services/extraction/image/simd_vectors.hpp"

namespace arcstart::extraction {
namespace {

constexpr int kRows = SmoothedGrid::kRows;  // at once

// A row of cells.
struct Grid {
  const std::uint16_t* eighths;  // its first known row
  std::ptrdiff_t stride;
  const std::uint16_t* asked;  // of each cell
  int cell_columns;
  std::uint16_t* highest;  // of each cell, of the first known row
  std::ptrdiff_t highest_stride;
};

// Down to rows 2 above and 2 below; x eight times what hessian_bound.hpp says, of eighths.
template <int kFloats>
ARCSTART_INLINE_BODY void bend_at(const Grid& grid, int x) {
  using Values = typename Register<kFloats>::SignedWords;
  Values second[kRows + 4], first[kRows + 4], sum[kRows + 4];  // along x
  for (int k = 0; k < kRows + 4; ++k) {
    const std::uint16_t* line = grid.eighths + (k - 2) * grid.stride + x;
    const auto here = load_as<Values>(line), left = load_as<Values>(line - 1),
               right = load_as<Values>(line + 1), far_left = load_as<Values>(line - 2),
               far_right = load_as<Values>(line + 2);
    second[k] = far_left + far_right - 2 * here;
    first[k] = (far_right - far_left + 4 * (right - left)) >> 3;
    sum[k] = left + here + right;
  }
  for (int k = 2; k < kRows + 2; ++k) {
    const Values xx = second[k - 1] + second[k] + second[k + 1];                        // x 384
    const Values yy = sum[k - 2] + sum[k + 2] - 2 * sum[k];                             // x 384
    const Values xy = first[k + 2] - first[k - 2] + 4 * (first[k + 1] - first[k - 1]);  // x 576
    const Values down = higher_of(-xx, -yy);                      // at most 12 240
    const Values bend = down + (down >> 1) + higher_of(xy, -xy);  // at most 31 110
    store(grid.highest + (k - 2) * grid.highest_stride + x / SmoothedGrid::kColumns,
          highest_of_fours<kFloats>((Words<kFloats>)higher_of(Values{}, bend)));
  }
}

// A row of cells.
template <int kFloats>
ARCSTART_INLINE_BODY void measure_bend_body(const Grid& grid) {
  using Asked = typename Register<kFloats>::Fours;
  for (int cell = 0; cell < grid.cell_columns; cell += kFloats / 2) {
    const auto asked = load_as<Asked>(grid.asked + cell);
    constexpr Asked kNone{};
    if (std::memcmp(&asked, &kNone, sizeof asked) != 0)
      bend_at<kFloats>(grid, cell * SmoothedGrid::kColumns);
  }
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(measure_bend, (const Grid& grid), (grid))

}  // namespace

void SecondDifferences::measure(const SmoothedGrid& grid, const CellPlane& asked) {
  highest_.resize(grid.cell_columns(), grid.cell_rows() * kRows);
  for (int row = 1; row + 1 < grid.cell_rows(); ++row) {
    const int y = row * kRows;
    measure_bend({grid.row(y), grid.row(1) - grid.row(0), asked.row(row), grid.cell_columns(),
                  highest_.row(y), highest_.row(1) - highest_.row(0)});
    for (int k = 0; k < kRows; ++k) highest_.end_row(y + k);
  }
}

}  // namespace arcstart::extraction
