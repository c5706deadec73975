#include "services/extraction/rejection/grid_max_filter.hpp"

#include <algorithm>

#include "services/extraction/image/simd_vectors.hpp"

namespace arcstart::extraction {
namespace {

struct Widening {
  const std::uint16_t* from;
  std::uint16_t *work, *to;  // all of one stride
  std::ptrdiff_t stride;
  int columns, rows, step, reach_columns, reach_rows;
};

template <int kFloats>
ARCSTART_INLINE_BODY void widen_cells_body(const Widening& w) {
  using Values = Words<kFloats>;
  constexpr int kCount = 2 * kFloats;
  for (int row = 0; row < w.rows; ++row)
    for (int x = 0; x < w.columns; x += kCount) {
      const std::uint16_t* at = w.from + row * w.stride + x;
      Values highest = load_as<Values>(at);
      for (int c = 1; c <= w.reach_columns; ++c)
        highest = higher_of(highest, higher_of(load_as<Values>(at - c), load_as<Values>(at + c)));
      store(w.work + row * w.stride + x, highest);
    }
  for (int row = 0; row * w.step < w.rows; ++row) {
    const int begin = std::max(0, row * w.step - w.reach_rows),
              end = std::min(w.rows, (row + 1) * w.step + w.reach_rows);
    for (int x = 0; x < w.columns; x += kCount) {
      Values highest{};
      for (int r = begin; r < end; ++r)
        highest = higher_of(highest, load_as<Values>(w.work + r * w.stride + x));
      store(w.to + row * w.stride + x, highest);
    }
  }
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(widen_cells, (const Widening& widening), (widening))

}  // namespace

void CellPlane::resize(int columns, int rows) {
  if (columns == columns_ && rows == rows_) return;
  columns_ = columns;
  rows_ = rows;
  stride_ = kRoom + (columns + kRoom - 1) / kRoom * kRoom + kRoom;
  values_.assign(static_cast<std::size_t>(rows) * stride_, 0);
}

void CellPlane::end_row(int row) { std::fill_n(this->row(row) + columns_, kRoom, 0); }

void CellPlane::widen(int step, int reach_columns, int reach_rows, CellPlane& work,
                      CellPlane& widened) const {
  work.resize(columns_, rows_);
  widened.resize(columns_, (rows_ + step - 1) / step);
  widen_cells({row(0), work.row(0), widened.row(0), stride_, columns_, rows_, step,
               std::min(reach_columns, kRoom), reach_rows});
}

}  // namespace arcstart::extraction
