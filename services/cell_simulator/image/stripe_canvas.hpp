// The light of stripes on the sensor, before noise: short strokes with a Gaussian profile, summed.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace arcstart::cell_simulator {

// A short straight piece of a stripe's image.
struct Stroke {
  Eigen::Vector2d begin, end;  // px in the canvas, pixel centres at integers
  double sigma;                // of the profile across, without the optics' blur; px
  double peak;                 // of that profile; grey levels
  double speckle;              // contrast of the light's speckle
};

class StripeCanvas {
 public:
  // Blocks of pixels that know whether light has fallen on them.
  static constexpr int block_width = 32, block_height = 8;

  // blur: sigma of the optics' point spread; px. A pixel's own square adds its variance of 1/12.
  explicit StripeCanvas(double blur);

  // Dark, of this size. Costs as much as there was light before.
  void clear(int width, int height);

  // Adds a stroke. Strokes laid end to end make one even line: each ends in the blur's own soft
  // edge.
  void add(const Stroke& stroke);

  // Adds light without speckle to every pixel: grey levels by (column, row).
  template <class Light>
  void add_field(Light&& field) {
    std::fill(lit_.begin(), lit_.end(), std::uint8_t{1});
    for (int row = 0; row < height_; ++row)
      for (int column = 0; column < width_; ++column)
        light_[std::size_t(row) * stride_ + column] += field(column, row);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  int blocks_across() const { return blocks_across_; }
  bool lit(int block_x, int block_y) const { return lit_[block_y * blocks_across_ + block_x] != 0; }

  // Grey levels of a row, and the same times each light's speckle contrast.
  std::span<const float> light(int row) const {
    return {&light_[std::size_t(row) * stride_], std::size_t(width_)};
  }
  std::span<const float> speckle(int row) const {
    return {&speckle_[std::size_t(row) * stride_], std::size_t(width_)};
  }

 private:
  double blur_;  // with the pixel's square
  int width_ = 0, height_ = 0, stride_ = 0, blocks_across_ = 0;
  std::vector<float> light_, speckle_;
  std::vector<std::uint8_t> lit_;
};

}  // namespace arcstart::cell_simulator
