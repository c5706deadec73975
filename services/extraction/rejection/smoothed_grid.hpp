// The image smoothed a little, and the range of its grey values cell by cell: all that is asked
// before any block is looked at.
#pragma once

#include <cstdint>
#include <vector>

#include "services/extraction/image/grey_image.hpp"
#include "services/extraction/rejection/grid_max_filter.hpp"

namespace arcstart::extraction {

// Highest value of each cell and highest complement: what the lowest lacks to `full`.
struct CellRanges {
  CellPlane highest, lowest_lacks;
};

// Some rows of cells of the grey values, smoothed with the binomial [1 4 6 4 1]/16 in both
// directions, mirrored at the border, known in every second column and row.
class SmoothedGrid {
 public:
  static constexpr int kCellWidth = 8, kCellHeight = 10;                    // px
  static constexpr int kColumns = kCellWidth / 2, kRows = kCellHeight / 2;  // known, of a cell
  static constexpr int kFull = 255 * 256;                                   // of smoothed

  // cell_columns: cover the image's width.
  void resize(int cell_columns, int cell_rows);
  // The first row of cells is that many down the image; rows outside it are its mirror image.
  void smooth(const GreyImage& image, int first_cell_row);

  int cell_columns() const { return smoothed_.highest.columns(); }
  int cell_rows() const { return smoothed_.highest.rows(); }
  // Grey values x 8, rounded down; two more to each side and at least a register behind.
  const std::uint16_t* row(int y) const { return eighths_.data() + y * stride_ + kBefore; }

  const CellRanges& smoothed() const { return smoothed_; }  // grey values x 256, full: kFull
  const CellRanges& plain() const { return plain_; }        // grey values, full: 255

 private:
  static constexpr int kBefore = 32, kAfter = 64;  // values before and behind a row

  std::ptrdiff_t stride_ = 0;
  std::vector<std::uint16_t> eighths_;
  std::vector<std::uint16_t> lines_;  // of a row of cells, smoothed down the image
  CellRanges smoothed_, plain_;
};

}  // namespace arcstart::extraction
