#include "services/extraction/centres/centre_refinement.hpp"

#include <algorithm>
#include <cmath>

#include "services/extraction/centres/stripe_quality.hpp"

namespace arcstart::extraction {

void refine_centres(const std::vector<RidgePoint>& points, const StripePath& selection, int reach,
                    double sigma, double noise, std::vector<RidgePoint>& measured,
                    std::vector<MeasuredCentre>& centres) {
  const auto line = [&](const RidgePoint& p) { return selection.along_rows ? p.row : p.column; };
  const auto across = [&](const RidgePoint& p) { return selection.along_rows ? p.u : p.v; };
  const auto before = [&](const RidgePoint& a, const RidgePoint& b) {
    return line(a) != line(b) ? line(a) < line(b) : across(a) < across(b);
  };
  std::sort(measured.begin(), measured.end(), before);
  for (const Branch& branch : selection.branches) {
    if (!branch.chosen) continue;
    for (const int i : branch.points) {
      const RidgePoint& p = points[i];
      const auto after = std::lower_bound(measured.begin(), measured.end(), p, before);
      const RidgePoint* nearest = nullptr;
      const auto consider = [&](const RidgePoint& q) {
        const float distance = std::abs(across(q) - across(p));
        if (line(q) == line(p) && distance <= static_cast<float>(reach) &&
            (nearest == nullptr || distance < std::abs(across(*nearest) - across(p))))
          nearest = &q;
      };
      if (after != measured.end()) consider(*after);
      if (after != measured.begin()) consider(*(after - 1));
      if (nearest != nullptr)
        centres[i] = {nearest->u, nearest->v,
                      static_cast<float>(centre_deviation(nearest->curvature, sigma, noise)),
                      static_cast<float>(sigma)};
    }
  }
}

}  // namespace arcstart::extraction
