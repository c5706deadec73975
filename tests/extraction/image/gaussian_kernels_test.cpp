#include "services/extraction/image/gaussian_kernels.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

double moment(const std::vector<double>& taps, bool odd, int power) {
  double sum = 0;
  const int half = static_cast<int>(taps.size()) - 1;
  for (int k = -half; k <= half; ++k)
    sum += (odd && k < 0 ? -1 : 1) * taps[std::abs(k)] * std::pow(k, power);
  return sum;
}

}  // namespace

TEST_CASE("kernels smooth and differentiate polynomials exactly") {
  const double sigma = GENERATE(0.8, 1.2, 1.7, 2.5, 4.0, 7.3, 12.0);
  const GaussianKernels kernels = gaussian_kernels(sigma);
  CHECK(kernels.half_width >= 3.6 * sigma);
  REQUIRE(kernels.smooth.size() == static_cast<std::size_t>(kernels.half_width) + 1);
  REQUIRE(kernels.first.size() == kernels.smooth.size());
  REQUIRE(kernels.second.size() == kernels.smooth.size());
  CHECK(moment(kernels.smooth, false, 0) == Approx(1).margin(1e-12));
  CHECK(kernels.first[0] == Approx(0).margin(1e-15));
  CHECK(moment(kernels.first, true, 1) == Approx(1).margin(1e-12));
  CHECK(moment(kernels.second, false, 0) == Approx(0).margin(1e-12));
  CHECK(moment(kernels.second, false, 2) == Approx(2).margin(1e-11));
}

TEST_CASE("kernels are the Gaussian's derivatives integrated over a pixel") {
  const double sigma = GENERATE(1.2, 2.5, 6.0);
  const GaussianKernels kernels = gaussian_kernels(sigma);
  // Midpoint rule over the pixel, of the derivatives written out.
  const auto integrate = [&](int k, int order) {
    constexpr int kSteps = 2000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double x = k - 0.5 + (i + 0.5) / kSteps, s2 = sigma * sigma;
      const double g = std::exp(-x * x / (2 * s2)) / (sigma * std::sqrt(2 * std::numbers::pi));
      sum += order == 0 ? g : order == 1 ? x / s2 * g : (x * x / s2 - 1) / s2 * g;
    }
    return sum / kSteps;
  };
  for (int k = 0; k <= kernels.half_width; ++k) {
    // Renormalising changes them by what was cut off beyond 3.6 sigma, 1.4 % of the second
    // derivative's moment.
    CHECK(kernels.smooth[k] == Approx(integrate(k, 0)).epsilon(1e-3).margin(1e-9));
    CHECK(kernels.first[k] == Approx(integrate(k, 1)).epsilon(0.02).margin(1e-9));
    CHECK(kernels.second[k] ==
          Approx(integrate(k, 2)).epsilon(0.05).margin(1e-3 / (sigma * sigma)));
  }
  // Its variance: the Gaussian's and the pixel's.
  CHECK(moment(kernels.smooth, false, 2) == Approx(sigma * sigma + 1.0 / 12).epsilon(0.01));
}
