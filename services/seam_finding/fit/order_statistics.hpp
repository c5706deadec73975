// Medians and quantiles: one element of a list, by its place in rising order.
//
// Two conventions are in use, and each caller keeps its own, for they differ by one place in short
// lists. Of n values quantile() takes place share * (n - 1), rounded down: 0 is the least value, 1
// the greatest. upper_quantile() takes place share * n, rounded down: of an even number of values
// the median is the upper of the two in the middle. All of them reorder the list they are given,
// and give 0 for an empty one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace arcstart::seam_finding {

template <class Value>
Value value_at(std::vector<Value>& values, std::size_t place) {
  if (values.empty()) return 0;
  const auto wanted = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), wanted, values.end());
  return *wanted;
}

// share: 0..1
template <class Value>
Value quantile(std::vector<Value>& values, double share) {
  const std::size_t last = values.empty() ? 0 : values.size() - 1;
  return value_at(values, static_cast<std::size_t>(share * static_cast<double>(last)));
}

// share: from 0 to below 1
template <class Value>
Value upper_quantile(std::vector<Value>& values, double share) {
  return value_at(values, static_cast<std::size_t>(share * static_cast<double>(values.size())));
}

template <class Value>
Value median(std::vector<Value>& values) {
  return value_at(values, values.size() / 2);
}

}  // namespace arcstart::seam_finding
