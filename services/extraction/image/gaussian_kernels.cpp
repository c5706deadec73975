#include "services/extraction/image/gaussian_kernels.hpp"

#include <cmath>
#include <numbers>

namespace arcstart::extraction {

GaussianKernels gaussian_kernels(double sigma) {
  const auto integral = [sigma](double x) { return 0.5 * std::erf(x / (sigma * std::sqrt(2.0))); };
  const auto density = [sigma](double x) {
    return std::exp(-x * x / (2 * sigma * sigma)) / (sigma * std::sqrt(2 * std::numbers::pi));
  };
  const auto slope = [&](double x) { return -x / (sigma * sigma) * density(x); };

  GaussianKernels kernels;
  kernels.sigma = sigma;
  kernels.half_width = static_cast<int>(std::ceil(3.6 * sigma));
  for (int k = 0; k <= kernels.half_width; ++k) {
    kernels.smooth.push_back(integral(k + 0.5) - integral(k - 0.5));
    kernels.first.push_back(density(k - 0.5) -
                            density(k + 0.5));  // minus: correlation, not convolution
    kernels.second.push_back(slope(k + 0.5) - slope(k - 0.5));
  }

  // Sum over both sides of tap[k] k^power.
  const auto moment = [&](const std::vector<double>& taps, int power) {
    double sum = power == 0 ? taps[0] : 0;
    for (int k = 1; k <= kernels.half_width; ++k) sum += 2 * taps[k] * std::pow(k, power);
    return sum;
  };
  const auto scale = [](std::vector<double>& taps, double factor) {
    for (double& tap : taps) tap *= factor;
  };
  scale(kernels.smooth, 1 / moment(kernels.smooth, 0));
  scale(kernels.first, 1 / moment(kernels.first, 1));
  const double rest = moment(kernels.second, 0);
  for (int k = 0; k <= kernels.half_width; ++k) kernels.second[k] -= rest * kernels.smooth[k];
  scale(kernels.second, 2 / moment(kernels.second, 2));
  return kernels;
}

}  // namespace arcstart::extraction
