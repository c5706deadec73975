#include "services/extraction/centres/centre_refinement.hpp"

#include <algorithm>
#include <cmath>

namespace arcstart::extraction {

MeasuredAgain::MeasuredAgain(std::vector<RidgePoint>& measured, bool along_rows)
    : measured_(measured), along_rows_(along_rows) {
  std::sort(measured.begin(), measured.end(),
            [this](const RidgePoint& a, const RidgePoint& b) { return before(a, b); });
}

const RidgePoint* MeasuredAgain::beside(const RidgePoint& point, int reach) const {
  const auto after =
      std::lower_bound(measured_.begin(), measured_.end(), point,
                       [this](const RidgePoint& a, const RidgePoint& b) { return before(a, b); });
  const RidgePoint* nearest = nullptr;
  const auto consider = [&](const RidgePoint& q) {
    const float distance = std::abs(across(q) - across(point));
    if (line(q) == line(point) && distance <= static_cast<float>(reach) &&
        (nearest == nullptr || distance < std::abs(across(*nearest) - across(point))))
      nearest = &q;
  };
  if (after != measured_.end()) consider(*after);
  if (after != measured_.begin()) consider(*(after - 1));
  return nearest;
}

}  // namespace arcstart::extraction
