// A value below which a share of others lies.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace arcstart::seam_finding {

// share: 0 to below 1; 0.5 is the (upper) median. Reorders the values, of which there is one at
// least.
inline double quantile_of(std::vector<double>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace arcstart::seam_finding
