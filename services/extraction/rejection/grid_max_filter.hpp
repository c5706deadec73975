// One value for each of the cells that lie over an image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace arcstart::extraction {

class CellPlane {
 public:
  // All 0, unless it has that size already.
  void resize(int columns, int rows);
  int columns() const { return columns_; }
  int rows() const { return rows_; }

  // To be written in whole registers of up to 16 cells, which may end behind the row; then
  // end_row.
  std::uint16_t* row(int row) { return values_.data() + row * stride_ + kRoom; }
  const std::uint16_t* row(int row) const { return values_.data() + row * stride_ + kRoom; }
  void end_row(int row);

  // The highest value of each `step` rows, of the rows and columns within reach of them as well.
  // work: of any size.
  void widen(int step, int reach_columns, int reach_rows, CellPlane& work,
             CellPlane& widened) const;

 private:
  static constexpr int kRoom = 32;  // cells of 0 on both sides of a row

  int columns_ = 0, rows_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<std::uint16_t> values_;
};

}  // namespace arcstart::extraction
