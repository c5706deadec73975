#include "services/extraction/rejection/curvature_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace arcstart::extraction {
namespace {

// Taps -reach .. reach, on every pixel.
using Taps = std::vector<double>;

constexpr double kBinomial[] = {6.0 / 16, 4.0 / 16, 1.0 / 16};  // at 0, +-1, +-2

Taps both_sides(const std::vector<double>& taps, bool odd, int reach) {
  Taps all(2 * reach + 1, 0.0);
  for (int k = 0; k < static_cast<int>(taps.size()); ++k) {
    all[reach + k] = taps[k];
    all[reach - k] = odd ? -taps[k] : taps[k];
  }
  return all;
}

double norm(const Taps& taps) {
  double sum = 0;
  for (const double tap : taps) sum += std::abs(tap);
  return sum;
}

double sum_of(const Taps& taps) {
  double sum = 0;
  for (const double tap : taps) sum += tap;
  return sum;
}

Taps binomial_of(const Taps& taps) {
  const int size = static_cast<int>(taps.size());
  Taps smoothed(taps.size(), 0.0);
  for (int i = 0; i < size; ++i)
    for (int k = std::max(-2, -i); k <= std::min(2, size - 1 - i); ++k)
      smoothed[i] += kBinomial[std::abs(k)] * taps[i + k];
  return smoothed;
}

// r on the places `first`, first + 2 ... within `within` of the middle, the binomial of which comes
// nearest to the taps (least squares). The normal equations have the binomial's autocorrelation on
// five diagonals and are diagonally dominant: Gauss-Seidel.
Taps undo_binomial(const Taps& taps, int first, int within) {
  constexpr double kAuto[] = {70.0 / 256, 28.0 / 256, 1.0 / 256};
  const Taps wanted = binomial_of(taps);
  const int middle = static_cast<int>(taps.size()) / 2;
  const int begin = first + 2 * ((middle - within - first + 1) / 2), end = middle + within;
  Taps r(taps.size(), 0.0);
  for (int sweep = 0; sweep < 60; ++sweep)
    for (int i = begin; i <= end; i += 2)
      r[i] = (wanted[i] - kAuto[1] * (r[i - 2] + r[i + 2]) - kAuto[2] * (r[i - 4] + r[i + 4])) /
             kAuto[0];
  return r;
}

// One kernel's whole = binomial * r + rest.
struct Split {
  Taps whole, r, smoothed_r;
  double rest;  // its norm

  Split(const Taps& taps, const Taps& undone)
      : whole(taps), r(undone), smoothed_r(binomial_of(r)), rest(0) {
    for (std::size_t i = 0; i < whole.size(); ++i) rest += std::abs(whole[i] - smoothed_r[i]);
  }
};

// The three kernels at a pixel in a known column (or row), or between two of them.
struct Place {
  Split smooth, first, second;

  Place(const GaussianKernels& kernels, int reach, int within, bool between)
      : smooth(split(both_sides(kernels.smooth, false, reach), within, between)),
        first(split(both_sides(kernels.first, true, reach), within, between)),
        second(split(both_sides(kernels.second, false, reach), within, between)) {
    // Zero sum, as the bound needs; the first derivative's has it by its symmetry.
    const double share = sum_of(second.r) / sum_of(smooth.r);
    Taps r = second.r;
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= share * smooth.r[i];
    second = Split(second.whole, r);
  }

 private:
  static Split split(const Taps& taps, int within, bool between) {
    const int middle = static_cast<int>(taps.size()) / 2;
    return {taps, undo_binomial(taps, (middle + (between ? 1 : 0)) % 2, within)};
  }
};

// 1/2 |R|_1 along the direction at an angle to the columns.
double half_norm(const Place& u, const Place& v, double angle) {
  const double uu = std::cos(angle) * std::cos(angle), vv = std::sin(angle) * std::sin(angle);
  const double uv = 2 * std::cos(angle) * std::sin(angle);
  double sum = 0;
  for (std::size_t i = 0; i < u.smooth.r.size(); ++i) {
    if (u.smooth.r[i] == 0) continue;
    for (std::size_t j = 0; j < v.smooth.r.size(); ++j)
      sum += std::abs(uu * u.second.r[i] * v.smooth.r[j] + uv * u.first.r[i] * v.first.r[j] +
                      vv * u.smooth.r[i] * v.second.r[j]);
  }
  return sum / 2;
}

// 1/2 |E|_1: a product's rest is rest x whole + smoothed x rest. The mixed derivative's weight 2
// cos sin is at most 1.
double half_rest(const Place& u, const Place& v) {
  const double uu =
      u.second.rest * norm(v.smooth.whole) + norm(u.second.smoothed_r) * v.smooth.rest;
  const double vv =
      v.second.rest * norm(u.smooth.whole) + norm(v.second.smoothed_r) * u.smooth.rest;
  const double uv = u.first.rest * norm(v.first.whole) + norm(u.first.smoothed_r) * v.first.rest;
  return 0.5 * (std::max(uu, vv) + uv);
}

}  // namespace

CurvatureBound curvature_bound(const GaussianKernels& kernels) {
  const int within = kernels.half_width + 1, reach = within + 2;
  constexpr int kRoom = 4;  // so that no index leaves the taps
  const std::array<Place, 2> places{Place(kernels, reach + kRoom, within, false),
                                    Place(kernels, reach + kRoom, within, true)};
  double largest = 0, rest = 0;
  // Mirrored kernels are their own: a quarter turn is enough. Between two of the angles the kernel
  // differs from one on the chord, where the norm is convex, by 1 - cos(pi/32) < 0.5 % at most.
  constexpr int kSteps = 16;
  for (const Place& u : places)
    for (const Place& v : places) {
      for (int step = 0; step <= kSteps; ++step)
        largest = std::max(largest, half_norm(u, v, std::numbers::pi / 2 * step / kSteps));
      rest = std::max(rest, half_rest(u, v));
    }
  return {within, reach, 1.005 * largest, rest};
}

}  // namespace arcstart::extraction
