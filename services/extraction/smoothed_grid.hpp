// The image smoothed a little, and the range of its grey values cell by cell: all that is asked
// before any block is looked at.
#pragma once

#include <cstdint>
#include <vector>

#include "services/extraction/cell_plane.hpp"
#include "services/extraction/grey_image.hpp"

namespace arcstart {

// Highest value of each cell and highest complement: what the lowest lacks to `full`.
struct CellRanges {
  CellPlane highest, lowest_lacks;
};

// The grey values smoothed with the binomial [1 4 6 4 1]/16 in both directions, mirrored at the
// border, known in every second column and row.
class SmoothedGrid {
 public:
  static constexpr int kCellWidth = 8, kCellHeight = 10;                    // px
  static constexpr int kColumns = kCellWidth / 2, kRows = kCellHeight / 2;  // known, of a cell
  static constexpr int kFull = 255 * 256;                                   // of smoothed

  // For images of this size; cell_columns of cells cover their width. strips: that smooth at once.
  void resize(int image_width, int image_height, int cell_columns, int strips);
  // The cells' rows begin .. end-1, and their ranges.
  void smooth(const GreyImage& image, int strip, int begin, int end);
  // Mirrors at the border what all strips have smoothed.
  void mirror();

  int cell_columns() const { return smoothed_.highest.columns(); }
  int cell_rows() const { return smoothed_.highest.rows(); }
  int known_rows() const { return known_rows_; }
  // Grey values x 8, rounded down; two more to each side and at least a register behind.
  const std::uint16_t* row(int y) const {
    return eighths_.data() + (y + kRoom) * stride_ + kBefore;
  }

  const CellRanges& smoothed() const { return smoothed_; }  // grey values x 256, full: kFull
  const CellRanges& plain() const { return plain_; }        // grey values, full: 255

 private:
  static constexpr int kRoom = 2;                  // mirrored rows above and below
  static constexpr int kBefore = 32, kAfter = 64;  // values before and behind a row
  std::uint16_t* row(int y) { return eighths_.data() + (y + kRoom) * stride_ + kBefore; }

  int image_width_ = 0, image_height_ = 0, known_rows_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<std::uint16_t> eighths_;
  std::vector<std::vector<std::uint16_t>> lines_;  // of each strip
  CellRanges smoothed_, plain_;
};

}  // namespace arcstart
