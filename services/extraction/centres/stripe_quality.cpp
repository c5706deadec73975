#include "services/extraction/centres/stripe_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/instruction_sets.hpp"

namespace arcstart::extraction {
namespace {

constexpr int kMostReach = 64;  // px to each side of a profile
constexpr int kNeighbours = 4;  // to each side whose profiles are averaged with a point's own

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

// The grey values across a line, at p + k normal for k = -reach .. reach.
void sample_profile(const GreyImage& image, float u, float v, float normal_u, float normal_v,
                    int reach, float* profile) {
  const float far_u = std::abs(normal_u) * static_cast<float>(reach) + 1,
              far_v = std::abs(normal_v) * static_cast<float>(reach) + 1;
  const bool inside = u > far_u && v > far_v && u + far_u < static_cast<float>(image.width - 1) &&
                      v + far_v < static_cast<float>(image.height - 1);
  const int size = 2 * reach + 1;
  if (!inside) {
    for (int i = 0; i < size; ++i) {
      const auto k = static_cast<float>(i - reach);
      profile[i] = static_cast<float>(grey_at(image, u + k * normal_u, v + k * normal_v));
    }
    return;
  }
  // A step at a time for all, so that the compiler takes several at once where it can.
  std::array<int, 2 * kMostReach + 1> columns, rows, above_left, above_right, below_left,
      below_right;
  std::array<float, 2 * kMostReach + 1> du, dv;
  for (int i = 0; i < size; ++i) {
    const auto k = static_cast<float>(i - reach);
    const float at_u = u + k * normal_u, at_v = v + k * normal_v;
    columns[i] = static_cast<int>(at_u);
    rows[i] = static_cast<int>(at_v);
    du[i] = at_u - static_cast<float>(columns[i]);
    dv[i] = at_v - static_cast<float>(rows[i]);
  }
  for (int i = 0; i < size; ++i) {
    const std::uint8_t *above = image.row(rows[i]) + columns[i], *below = above + image.stride;
    above_left[i] = above[0];
    above_right[i] = above[1];
    below_left[i] = below[0];
    below_right[i] = below[1];
  }
  for (int i = 0; i < size; ++i) {
    const float a = static_cast<float>(above_left[i]) +
                    du[i] * static_cast<float>(above_right[i] - above_left[i]);
    const float b = static_cast<float>(below_left[i]) +
                    du[i] * static_cast<float>(below_right[i] - below_left[i]);
    profile[i] = a + dv[i] * (b - a);
  }
}

// Where the profile falls below the level, going from `at` by `step`; between the samples. At most
// the last sample.
double crossing(const float* profile, int size, int at, int step, double level) {
  while (at + step >= 0 && at + step < size && profile[at + step] > level) at += step;
  if (at + step < 0 || at + step >= size) return at;
  return at + step * (profile[at] - level) / (profile[at] - profile[at + step]);
}

// Half the width at half the height is 1.177 standard deviations of a Gaussian and sqrt(3) of a
// bar, to which a clipped Gaussian comes the nearer, the more of it is clipped.
double profile_width(std::span<const float> raw, double sigma, double noise) {
  // The sides' level: the median of the outer quarter of each, joined by a line.
  const int size = static_cast<int>(raw.size()), reach = size / 2, quarter = std::max(2, reach / 4);
  std::array<float, kMostReach> side;
  const auto level = [&](int begin) {
    std::copy_n(raw.begin() + begin, quarter, side.begin());
    std::nth_element(side.begin(), side.begin() + quarter / 2, side.begin() + quarter);
    return side[quarter / 2];
  };
  const float left = level(0), right = level(size - quarter);
  std::array<float, 2 * kMostReach + 1> profile;
  for (int i = 0; i < size; ++i)
    profile[i] =
        raw[i] - left - (right - left) * static_cast<float>(i) / static_cast<float>(size - 1);

  const int near = std::max(1, static_cast<int>(sigma));
  const auto top =
      std::max_element(profile.begin() + reach - near, profile.begin() + reach + near + 1);
  if (*top <= 2 * noise) return 0;
  const int at = static_cast<int>(top - profile.begin());
  const double half_width = 0.5 * (crossing(profile.data(), size, at, 1, *top / 2) -
                                   crossing(profile.data(), size, at, -1, *top / 2));
  int white = 0;
  for (int i = at; i < size && raw[i] > 254; ++i) ++white;
  for (int i = at - 1; i >= 0 && raw[i] > 254; --i) ++white;
  const double flat = std::min(1.0, white / (2 * half_width));
  const double width = half_width * ((1 - flat) / 1.1774 + flat / std::numbers::sqrt3);
  constexpr double kPixel = 1.0 / 12,
                   kInterpolation = 1.0 / 6;  // what they add to a profile's variance
  return std::sqrt(std::max(width * width - kPixel - kInterpolation, 0.01));
}

}  // namespace

namespace {

constexpr int kPatch = 16;

struct Patch {
  const std::uint8_t* greys;  // its upper left pixel
  std::ptrdiff_t stride;
  int sum;  // of the mask's absolute responses
};

template <int>
ARCSTART_INLINE_BODY void add_up_body(Patch& patch) {
  int sum = 0;
  for (int v = 0; v < kPatch; ++v) {
    const std::uint8_t *b = patch.greys + v * patch.stride, *a = b - patch.stride,
                       *c = b + patch.stride;
    for (int u = 0; u < kPatch; ++u)
      sum += std::abs(a[u - 1] - 2 * a[u] + a[u + 1] - 2 * (b[u - 1] - 2 * b[u] + b[u + 1]) +
                      c[u - 1] - 2 * c[u] + c[u + 1]);
  }
  patch.sum = sum;
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(add_up, (Patch & patch), (patch))

}  // namespace

double noise_of(const GreyImage& image) {
  constexpr int kPatchesAcross = 24;
  if (std::min(image.width, image.height) < kPatch + 2) return 0;
  std::array<int, kPatchesAcross * kPatchesAcross> sums;
  for (int j = 0; j < kPatchesAcross; ++j)
    for (int i = 0; i < kPatchesAcross; ++i) {
      const int u0 = 1 + (image.width - 2 - kPatch) * i / (kPatchesAcross - 1);
      const int v0 = 1 + (image.height - 2 - kPatch) * j / (kPatchesAcross - 1);
      Patch patch{image.row(v0) + u0, image.stride, 0};
      add_up(patch);
      sums[j * kPatchesAcross + i] = patch.sum;
    }
  std::nth_element(sums.begin(), sums.begin() + sums.size() / 2, sums.end());
  // The mask's response to unit noise has a standard deviation of 6, its absolute value a mean of
  // sqrt(2/pi) of that.
  const double noise =
      sums[sums.size() / 2] / (6.0 * kPatch * kPatch) * std::sqrt(std::numbers::pi / 2);
  return std::max(noise, 1 / std::sqrt(12.0));
}

void measure_widths(const GreyImage& image, const std::vector<RidgePoint>& points,
                    std::span<const int> chain, double sigma, double noise,
                    std::vector<float>& widths, Memory memory) {
  const int reach = std::min(kMostReach, static_cast<int>(std::ceil(5 * sigma)) + 2);
  const int size = 2 * reach + 1, count = static_cast<int>(chain.size());
  FrameVector<float> profiles(static_cast<std::size_t>(size) * count, memory), mean(size, memory),
      sum(size, 0.0f, memory);
  float sense = 1;  // normals have none of their own: neighbours' are made alike
  for (int i = 0; i < count; ++i) {
    const RidgePoint& p = points[chain[i]];
    if (i > 0) {
      const RidgePoint& before = points[chain[i - 1]];
      if (p.normal_u * before.normal_u + p.normal_v * before.normal_v < 0) sense = -sense;
    }
    sample_profile(image, p.u, p.v, sense * p.normal_u, sense * p.normal_v, reach,
                   &profiles[static_cast<std::size_t>(i) * size]);
  }
  const auto add = [&](int i, float sign) {
    const float* profile = &profiles[static_cast<std::size_t>(i) * size];
    for (int k = 0; k < size; ++k) sum[k] += sign * profile[k];
  };
  for (int i = 0; i < std::min(kNeighbours, count); ++i) add(i, 1);
  for (int i = 0; i < count; ++i) {
    if (i + kNeighbours < count) add(i + kNeighbours, 1);
    if (i - kNeighbours > 0) add(i - kNeighbours - 1, -1);
    const int begin = std::max(0, i - kNeighbours), end = std::min(count, i + kNeighbours + 1);
    for (int k = 0; k < size; ++k) mean[k] = sum[k] / static_cast<float>(end - begin);
    widths[chain[i]] = static_cast<float>(profile_width(mean, sigma, noise));
  }
}

double centre_deviation(double curvature, double sigma, double noise) {
  return 0.1995 * noise / (curvature * sigma * sigma);
}

double white_width(const GreyImage& image) {
  std::int64_t white = 0;
  for (int v = 0; v < image.height; ++v)
    white += std::count(image.row(v), image.row(v) + image.width, 255);
  return static_cast<double>(white) / std::max(image.width, image.height);
}

bool is_saturated(const GreyImage& image, double u, double v) {
  const int column = std::clamp(static_cast<int>(std::lround(u)), 0, image.width - 1);
  const int row = std::clamp(static_cast<int>(std::lround(v)), 0, image.height - 1);
  return image.at(column, row) == 255;
}

}  // namespace arcstart::extraction
