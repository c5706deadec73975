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
#include <iterator>
#include <type_traits>

namespace arcstart {

// Values: a list with random access, as std::vector<double>.
template <class Values>
auto value_at(Values&& values, std::size_t place) {
  using Value = typename std::remove_reference_t<Values>::value_type;
  if (std::empty(values)) return Value(0);
  const auto wanted = std::begin(values) + static_cast<std::ptrdiff_t>(place);
  std::nth_element(std::begin(values), wanted, std::end(values));
  return *wanted;
}

// share: 0..1
template <class Values>
auto quantile(Values&& values, double share) {
  const std::size_t last = std::empty(values) ? 0 : std::size(values) - 1;
  return value_at(values, static_cast<std::size_t>(share * static_cast<double>(last)));
}

// share: from 0 to below 1
template <class Values>
auto upper_quantile(Values&& values, double share) {
  return value_at(values, static_cast<std::size_t>(share * static_cast<double>(std::size(values))));
}

template <class Values>
auto median(Values&& values) {
  return value_at(values, std::size(values) / 2);
}

}  // namespace arcstart
