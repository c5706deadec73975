// Second differences of the smoothed image, block by block: how far down it bends at most.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace arcstart {

// Of what bend_bound.hpp calls b: the grey values smoothed with the binomial, x 256, in every
// second column and row.
class SecondDifferences {
 public:
  static constexpr int kWidth = 8, kHeight = 5;  // of a block, in known columns and rows

  // For an image of this size, in px; block_columns of them cover its width.
  void resize(int image_width, int image_height, int block_columns);
  std::uint16_t* row(int y) {  // to be written, kWidth values a block
    return smoothed_.data() + (y + kRoom) * stride_ + kRoomBefore;
  }
  std::ptrdiff_t stride() const { return stride_; }

  // Blocks are numbered along the rows of blocks.
  void forget();
  void want(int block) {
    if (is_wanted_[block] != 0) return;
    is_wanted_[block] = 1;
    wanted_.push_back(block);
  }
  void find_highest();  // of the blocks wanted
  // The most of max(-xx, -yy) + |xy| in the block; grey values / px^2.
  float highest(int block) const { return highest_[block]; }

 private:
  static constexpr int kRoom = 2;         // mirrored rows above and below
  static constexpr int kRoomBefore = 16;  // values before a row
  void mirror();

  int image_width_ = 0, image_height_ = 0, columns_ = 0, rows_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<std::uint16_t> smoothed_;
  std::vector<int> wanted_;
  std::vector<std::uint8_t> is_wanted_;
  std::vector<float> highest_;
};

}  // namespace arcstart
