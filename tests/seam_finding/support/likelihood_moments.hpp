// Mean and deviation of a likelihood, as a test looks at it.
#pragma once

#include <cmath>

#include "services/seam_finding/ends/foot_likelihood.hpp"

namespace arcstart::seam_finding {

struct PlaceMoments {
  double mean = 0, deviation = 0;  // mm
};

inline PlaceMoments moments_of(const FootLikelihood& likelihood, const PlaceGrid& grid) {
  double sum = 0, places = 0, squares = 0;
  for (int i = 0; i < grid.count; ++i) {
    const double weight = likelihood.at[static_cast<std::size_t>(i)], place = grid.at(i);
    sum += weight, places += weight * place, squares += weight * place * place;
  }
  const double mean = places / sum;
  return {mean, std::sqrt(squares / sum - mean * mean)};
}

// Share of it between two places.
inline double share_between(const FootLikelihood& likelihood, const PlaceGrid& grid, double from,
                            double to) {
  double sum = 0, within = 0;
  for (int i = 0; i < grid.count; ++i) {
    const double weight = likelihood.at[static_cast<std::size_t>(i)];
    sum += weight;
    if (grid.at(i) >= from && grid.at(i) <= to) within += weight;
  }
  return within / sum;
}

}  // namespace arcstart::seam_finding
