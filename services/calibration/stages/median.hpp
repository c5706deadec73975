// The value in the middle.
#pragma once

#include <algorithm>
#include <vector>

namespace arcstart::calibration {

// Of an even number the upper of the two in the middle. values: not empty.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace arcstart::calibration
