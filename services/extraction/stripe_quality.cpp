#include "services/extraction/stripe_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace arcstart {
namespace {

// Between the pixels' centres, bilinear; the border's value beyond it.
double grey_at(const GreyImage& image, double u, double v) {
  u = std::clamp(u, 0.0, image.width - 1.0);
  v = std::clamp(v, 0.0, image.height - 1.0);
  const int column = std::min(static_cast<int>(u), std::max(0, image.width - 2));
  const int row = std::min(static_cast<int>(v), std::max(0, image.height - 2));
  const int right = std::min(column + 1, image.width - 1),
            below = std::min(row + 1, image.height - 1);
  const double du = u - column, dv = v - row;
  return (1 - dv) * ((1 - du) * image.at(column, row) + du * image.at(right, row)) +
         dv * ((1 - du) * image.at(column, below) + du * image.at(right, below));
}

// Share of a Gaussian's variance that is left when it is cut off at this share of its height.
double variance_above(double share) {
  const double a = std::sqrt(-2 * std::log(share));
  const double density = share / std::sqrt(2 * std::numbers::pi);
  return 1 - 2 * a * density / std::erf(a / std::numbers::sqrt2);
}

}  // namespace

double noise_of(const GreyImage& image) {
  constexpr int kPatch = 14, kPatchesAcross = 24;
  if (std::min(image.width, image.height) < kPatch + 2) return 0;
  std::vector<double> patches;
  for (int j = 0; j < kPatchesAcross; ++j)
    for (int i = 0; i < kPatchesAcross; ++i) {
      const int u0 = 1 + (image.width - 2 - kPatch) * i / (kPatchesAcross - 1);
      const int v0 = 1 + (image.height - 2 - kPatch) * j / (kPatchesAcross - 1);
      int sum = 0;
      for (int v = v0; v < v0 + kPatch; ++v) {
        const std::uint8_t *a = image.row(v - 1), *b = image.row(v), *c = image.row(v + 1);
        for (int u = u0; u < u0 + kPatch; ++u)
          sum += std::abs(a[u - 1] - 2 * a[u] + a[u + 1] - 2 * (b[u - 1] - 2 * b[u] + b[u + 1]) +
                          c[u - 1] - 2 * c[u] + c[u + 1]);
      }
      // The mask's response to unit noise has a standard deviation of 6, its absolute value a mean
      // of sqrt(2/pi) of that.
      patches.push_back(sum / (6.0 * kPatch * kPatch) * std::sqrt(std::numbers::pi / 2));
    }
  std::nth_element(patches.begin(), patches.begin() + patches.size() / 2, patches.end());
  return std::max(patches[patches.size() / 2], 1 / std::sqrt(12.0));
}

double profile_width(const GreyImage& image, const RidgePoint& point, double sigma, double noise) {
  constexpr int kMost = 64;
  const int reach = std::min(kMost, static_cast<int>(std::ceil(5 * sigma)) + 2);
  std::array<double, 2 * kMost + 1> profile;
  for (int k = -reach; k <= reach; ++k)
    profile[k + reach] = grey_at(image, point.u + k * point.normal_u, point.v + k * point.normal_v);

  // The sides' level: the median of the outer quarter of each, joined by a line.
  const int size = 2 * reach + 1, quarter = std::max(2, reach / 4);
  std::array<double, kMost> side;
  const auto level = [&](int begin) {
    std::copy_n(profile.begin() + begin, quarter, side.begin());
    std::nth_element(side.begin(), side.begin() + quarter / 2, side.begin() + quarter);
    return side[quarter / 2];
  };
  const double left = level(0), right = level(size - quarter);
  for (int i = 0; i < size; ++i) profile[i] -= left + (right - left) * i / (size - 1);

  const int near = std::max(1, static_cast<int>(sigma));
  const auto top =
      std::max_element(profile.begin() + reach - near, profile.begin() + reach + near + 1);
  const double height = *top;
  if (height <= 3 * noise) return 0;
  const double floor = std::clamp(2 * noise / height, 0.1, 0.5);
  int begin = static_cast<int>(top - profile.begin()), end = begin + 1;
  while (begin > 0 && profile[begin - 1] > floor * height) --begin;
  while (end < size && profile[end] > floor * height) ++end;
  double sum = 0, first = 0, second = 0;
  for (int i = begin; i < end; ++i) {
    sum += profile[i];
    first += profile[i] * i;
    second += profile[i] * i * i;
  }
  const double variance = (second - first * first / sum) / sum / variance_above(floor);
  constexpr double kPixel = 1.0 / 12,
                   kInterpolation = 1.0 / 6;  // what they add to a profile's variance
  return std::sqrt(std::max(variance - kPixel - kInterpolation, 0.01));
}

double centre_deviation(double curvature, double sigma, double noise) {
  return 0.1995 * noise / (curvature * sigma * sigma);
}

bool is_saturated(const GreyImage& image, double u, double v) {
  const int column = std::clamp(static_cast<int>(std::lround(u)), 0, image.width - 1);
  const int row = std::clamp(static_cast<int>(std::lround(v)), 0, image.height - 1);
  return image.at(column, row) == 255;
}

}  // namespace arcstart
