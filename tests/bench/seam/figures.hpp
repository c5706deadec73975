// Figures of a row of many seeds.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace arcstart {

// 0 of none.
inline double mean(const std::vector<double>& values) {
  return values.empty() ? 0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

// Nearest rank; 0 of none.
inline double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(
      std::max(1.0, std::ceil(share * static_cast<double>(values.size()))));
  return values[rank - 1];
}

// Of counts; 0 of none.
inline double share(int part, int all) {
  return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : 0;
}

}  // namespace arcstart
