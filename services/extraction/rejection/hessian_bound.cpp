#include "services/extraction/rejection/hessian_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace arcstart::extraction {
namespace {

// Taps -reach .. reach, on every pixel.
using Taps = std::vector<double>;

constexpr double kVariance = 11.0 / 3;  // of the second differences' smoothing; px^2
constexpr double kPixel = 1.0 / 12;     // of the kernels, which are integrated over the pixel; px^2

Taps convolve(const Taps& taps, const Taps& kernel) {
  const int size = static_cast<int>(taps.size()), half = static_cast<int>(kernel.size()) / 2;
  Taps result(taps.size(), 0.0);
  for (int i = 0; i < size; ++i)
    for (int k = -half; k <= half; ++k)
      if (i - k >= 0 && i - k < size) result[i] += kernel[k + half] * taps[i - k];
  return result;
}

Taps both_sides(const std::vector<double>& taps, bool odd, int reach) {
  Taps all(2 * reach + 1, 0.0);
  for (int k = 0; k < static_cast<int>(taps.size()); ++k) {
    all[reach + k] = taps[k];
    all[reach - k] = odd ? -taps[k] : taps[k];
  }
  return all;
}

// The three kernels along one axis and what stands for them, at a pixel in a known column (or row)
// or between two of them.
struct Axis {
  Taps smooth, first, second;                 // the kernels'
  Taps near_smooth, near_first, near_second;  // H's
  int reach = 0;                              // of H's weights

  Axis(const GaussianKernels& kernels, double variance, int room, bool between)
      : smooth(both_sides(kernels.smooth, false, room)),
        first(both_sides(kernels.first, true, room)),
        second(both_sides(kernels.second, false, room)) {
    Taps weights(smooth.size(), 0.0);
    double sum = 0;
    for (int k = -kernels.half_width; k <= kernels.half_width; ++k) {
      if ((k + kernels.half_width * 2) % 2 != (between ? 1 : 0)) continue;
      const double weight = std::exp(-k * k / (2 * variance));
      if (weight < 1e-3) continue;
      weights[room + k] = weight;
      sum += weight;
      reach = std::max(reach, std::abs(k));
    }
    for (double& weight : weights) weight /= sum;
    const Taps binomial = convolve(weights, {1 / 16.0, 4 / 16.0, 6 / 16.0, 4 / 16.0, 1 / 16.0});
    near_smooth = convolve(binomial, {1 / 3.0, 0, 1 / 3.0, 0, 1 / 3.0});
    near_first = convolve(binomial, {-1 / 24.0, 0, -4 / 24.0, 0, 0, 0, 4 / 24.0, 0, 1 / 24.0});
    near_second = convolve(binomial, {1 / 16.0, 0, 0, 0, -2 / 16.0, 0, 0, 0, 1 / 16.0});
  }
};

// |N|_1 and |E - N|_1.
struct Rest {
  double near = 0, far = 0;
};

// Along the direction at an angle to the columns.
Rest rest_of(const Axis& u, const Axis& v, double angle, int rest_reach) {
  const double uu = std::cos(angle) * std::cos(angle), vv = std::sin(angle) * std::sin(angle);
  const double uv = 2 * std::cos(angle) * std::sin(angle);
  const int middle = static_cast<int>(u.smooth.size()) / 2;
  Rest rest;
  double sum = 0;
  for (int i = 0; i <= 2 * middle; ++i)
    for (int j = 0; j <= 2 * middle; ++j) {
      const double e = uu * (u.second[i] * v.smooth[j] - u.near_second[i] * v.near_smooth[j]) +
                       uv * (u.first[i] * v.first[j] - u.near_first[i] * v.near_first[j]) +
                       vv * (u.smooth[i] * v.second[j] - u.near_smooth[i] * v.near_second[j]);
      if (std::max(std::abs(i - middle), std::abs(j - middle)) <= rest_reach) {
        rest.near += std::abs(e);
        sum += e;
      } else {
        rest.far += std::abs(e);
      }
    }
  rest.near += std::abs(sum);
  rest.far += std::abs(sum);
  return rest;
}

}  // namespace

HessianBound hessian_bound(const GaussianKernels& kernels, int rest_reach) {
  const double variance = kernels.sigma * kernels.sigma + kPixel - kVariance;
  if (variance < 1.5) return {};
  constexpr int kSpread = 6;  // of the binomial and the second differences, px
  const int room = kernels.half_width + kSpread;
  HessianBound bound;
  bound.holds = true;
  bound.rest_reach = std::min(rest_reach, room);
  const std::array<Axis, 2> places{Axis(kernels, variance, room, false),
                                   Axis(kernels, variance, room, true)};
  // A quarter turn is enough, and between two of the angles the kernel differs from one on the
  // chord, where the norm is convex, by 1 - cos(pi/16) < 2 % at most.
  constexpr int kSteps = 8;
  for (const Axis& u : places)
    for (const Axis& v : places) {
      bound.reach = std::max({bound.reach, u.reach, v.reach});
      for (int step = 0; step <= kSteps; ++step) {
        const Rest rest = rest_of(u, v, std::numbers::pi / 2 * step / kSteps, bound.rest_reach);
        bound.per_grey = std::max(bound.per_grey, 1.02 / 2 * rest.near);
        bound.far = std::max(bound.far, 1.02 * 255 / 2 * rest.far);
      }
    }
  return bound;
}

}  // namespace arcstart::extraction
