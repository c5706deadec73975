#include "services/cell_simulator/image/stripe_canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace arcstart::cell_simulator {
namespace {

constexpr double reach = 4;  // sigmas beyond which a profile is 0

// A function on [-reach, reach], looked up with linear interpolation; error below 1e-5.
class Table {
 public:
  template <class Function>
  explicit Table(Function function) {
    for (int i = 0; i <= size; ++i)
      values_[i] = static_cast<float>(function(reach * (2.0 * i / size - 1)));
  }
  float operator()(float x) const {
    const float at =
        std::clamp((x + float(reach)) * float(size / (2 * reach)), 0.0f, float(size) - 0.001f);
    const int index = static_cast<int>(at);
    return values_[index] +
           (at - static_cast<float>(index)) * (values_[index + 1] - values_[index]);
  }

 private:
  static constexpr int size = 1024;
  std::array<float, size + 1> values_;
};

const Table bell([](double x) { return std::exp(-x * x / 2); });
const Table step([](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); });

}  // namespace

StripeCanvas::StripeCanvas(double blur) : blur_(std::sqrt(blur * blur + 1.0 / 12)) {}

void StripeCanvas::clear(int width, int height) {
  if (width != width_ || height != height_) {
    width_ = width;
    height_ = height;
    blocks_across_ = (width + block_width - 1) / block_width;
    stride_ = blocks_across_ * block_width;
    const int blocks_down = (height + block_height - 1) / block_height;
    light_.assign(std::size_t(stride_) * height, 0);
    speckle_.assign(light_.size(), 0);
    lit_.assign(std::size_t(blocks_across_) * blocks_down, 0);
    return;
  }
  for (std::size_t block = 0; block < lit_.size(); ++block) {
    if (!lit_[block]) continue;
    lit_[block] = 0;
    const int top = static_cast<int>(block) / blocks_across_ * block_height;
    const int left = static_cast<int>(block) % blocks_across_ * block_width;
    for (int row = top; row < std::min(top + block_height, height_); ++row) {
      std::fill_n(&light_[std::size_t(row) * stride_ + left], block_width, 0.0f);
      std::fill_n(&speckle_[std::size_t(row) * stride_ + left], block_width, 0.0f);
    }
  }
}

void StripeCanvas::add(const Stroke& stroke) {
  const Eigen::Vector2d way = stroke.end - stroke.begin;
  const double length = way.norm();
  if (!(length > 1e-9) || !(stroke.peak > 0)) return;
  const Eigen::Vector2d along = way / length;
  const double sigma = std::hypot(stroke.sigma, blur_);
  const double peak =
      stroke.peak * stroke.sigma / sigma;  // blur spreads the light, it takes none away

  // The box that holds the stroke with its soft edges.
  const double across_reach = reach * sigma, along_reach = reach * blur_;
  const double grow_x = across_reach * std::abs(along.y()) + along_reach * std::abs(along.x());
  const double grow_y = across_reach * std::abs(along.x()) + along_reach * std::abs(along.y());
  const auto low = [](double a, double b, double grow) {
    return static_cast<int>(std::ceil(std::clamp(std::min(a, b) - grow, -1e6, 1e6)));
  };
  const auto high = [](double a, double b, double grow) {
    return static_cast<int>(std::floor(std::clamp(std::max(a, b) + grow, -1e6, 1e6)));
  };
  const int left = std::max(0, low(stroke.begin.x(), stroke.end.x(), grow_x));
  const int right = std::min(width_ - 1, high(stroke.begin.x(), stroke.end.x(), grow_x));
  const int top = std::max(0, low(stroke.begin.y(), stroke.end.y(), grow_y));
  const int bottom = std::min(height_ - 1, high(stroke.begin.y(), stroke.end.y(), grow_y));
  if (left > right || top > bottom) return;

  for (int block_y = top / block_height; block_y <= bottom / block_height; ++block_y)
    std::fill(&lit_[block_y * blocks_across_ + left / block_width],
              &lit_[block_y * blocks_across_ + right / block_width] + 1, std::uint8_t{1});

  const auto along_x = static_cast<float>(along.x() / blur_),
             along_y = static_cast<float>(along.y() / blur_);
  const auto across_x = static_cast<float>(-along.y() / sigma),
             across_y = static_cast<float>(along.x() / sigma);
  const auto end = static_cast<float>(length / blur_);
  const auto amplitude = static_cast<float>(peak), contrast = static_cast<float>(stroke.speckle);
  for (int row = top; row <= bottom; ++row) {
    const auto dy = static_cast<float>(row - stroke.begin.y());
    float* light = &light_[std::size_t(row) * stride_];
    float* speckle = &speckle_[std::size_t(row) * stride_];
    for (int column = left; column <= right; ++column) {
      const auto dx = static_cast<float>(column - stroke.begin.x());
      const float across = across_x * dx + across_y * dy;
      if (std::abs(across) >= float(reach)) continue;
      const float from_begin = along_x * dx + along_y * dy;
      const float grey = amplitude * bell(across) * (step(from_begin) - step(from_begin - end));
      light[column] += grey;
      speckle[column] += contrast * grey;
    }
  }
}

}  // namespace arcstart::cell_simulator
