#include "services/extraction/second_differences.hpp"

#include <algorithm>
#include <cstring>

#include "services/extraction/grey_image.hpp"
#include "services/extraction/instruction_sets.hpp"

namespace arcstart {
namespace {

constexpr int kWidth = SecondDifferences::kWidth, kHeight = SecondDifferences::kHeight;

struct Blocks {
  const std::uint16_t* smoothed;  // the first one
  std::ptrdiff_t stride;
  int columns, rows;  // of blocks, of known rows
  const int* wanted;
  std::size_t count;
  float* highest;
};

typedef std::int32_t Values __attribute__((vector_size(4 * kWidth)));
typedef std::uint16_t Stored __attribute__((vector_size(2 * kWidth)));

ARCSTART_INLINE_BODY Values load_values(const std::uint16_t* from) {
  Stored stored;
  std::memcpy(&stored, from, sizeof stored);
  return __builtin_convertvector(stored, Values);
}

ARCSTART_INLINE_BODY Values higher_of(Values a, Values b) { return a > b ? a : b; }

// All are whole numbers below 2^23.
template <int>
ARCSTART_INLINE_BODY void find_highest_of_body(const Blocks& blocks) {
  for (std::size_t i = 0; i < blocks.count; ++i) {
    const int block = blocks.wanted[i];
    const int row = block / blocks.columns * kHeight;
    const std::uint16_t* at = blocks.smoothed + row * blocks.stride +
                              static_cast<std::ptrdiff_t>(block % blocks.columns) * kWidth;
    // Of the known rows 2 above the block to 2 below it, along x.
    Values second[kHeight + 4], first[kHeight + 4], sum[kHeight + 4];
    for (int k = 0; k < kHeight + 4; ++k) {
      const std::uint16_t* line = at + (k - 2) * blocks.stride;
      const Values here = load_values(line), left = load_values(line - 1),
                   right = load_values(line + 1), far_left = load_values(line - 2),
                   far_right = load_values(line + 2);
      second[k] = far_left + far_right - 2 * here;
      first[k] = far_right - far_left + 4 * (right - left);
      sum[k] = left + here + right;
    }
    Values highest{};
    const int rows = std::min(kHeight, blocks.rows - row);
    for (int k = 2; k < rows + 2; ++k) {
      const Values xx = second[k - 1] + second[k] + second[k + 1];                        // x 48
      const Values yy = sum[k - 2] + sum[k + 2] - 2 * sum[k];                             // x 48
      const Values xy = first[k + 2] - first[k - 2] + 4 * (first[k + 1] - first[k - 1]);  // x 576
      highest = higher_of(highest, 12 * higher_of(-xx, -yy) + higher_of(xy, -xy));
    }
    for (const Values& order : {Values{4, 5, 6, 7, 0, 1, 2, 3}, Values{2, 3, 0, 1, 6, 7, 4, 5},
                                Values{1, 0, 3, 2, 5, 4, 7, 6}})
      highest = higher_of(highest, __builtin_shuffle(highest, order));
    blocks.highest[block] = static_cast<float>(highest[0]) / (576.0f * 256.0f);
  }
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(find_highest_of, (const Blocks& blocks), (blocks))

}  // namespace

void SecondDifferences::resize(int image_width, int image_height, int block_columns) {
  image_width_ = image_width;
  image_height_ = image_height;
  columns_ = block_columns;
  rows_ = (image_height + 1) / 2;
  stride_ = kRoomBefore + columns_ * kWidth + kRoomBefore;
  const int block_rows = (rows_ + kHeight - 1) / kHeight;
  smoothed_.resize(static_cast<std::size_t>(block_rows * kHeight + 2 * kRoom) * stride_);
  highest_.resize(static_cast<std::size_t>(columns_) * block_rows);
}

void SecondDifferences::forget() {
  wanted_.clear();
  is_wanted_.assign(highest_.size(), 0);
}

// Even places mirrored at a whole one are even places.
void SecondDifferences::mirror() {
  for (int y = 0; y < rows_; ++y) {
    std::uint16_t* line = row(y);
    const int end = columns_ * kWidth;
    for (const int x : {-2, -1, end, end + 1}) line[x] = line[reflect_101(2 * x, image_width_) / 2];
  }
  for (const int y : {-2, -1, rows_, rows_ + 1})
    std::copy_n(row(reflect_101(2 * y, image_height_) / 2) - kRoom, columns_ * kWidth + 2 * kRoom,
                row(y) - kRoom);
}

void SecondDifferences::find_highest() {
  if (wanted_.empty()) return;
  mirror();
  find_highest_of(
      {row(0), stride_, columns_, rows_, wanted_.data(), wanted_.size(), highest_.data()});
}

}  // namespace arcstart
