// Random numbers by seed.
#pragma once

#include <random>

namespace arcstart::seam_finding::synthetic {

struct Random {
  std::mt19937_64 engine;
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  double normal(double deviation) {
    return std::normal_distribution<double>(0, 1)(engine) * deviation;
  }
};

}  // namespace arcstart::seam_finding::synthetic
