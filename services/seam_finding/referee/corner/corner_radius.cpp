#include "services/seam_finding/referee/corner/corner_radius.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/order_statistics.hpp"
#include "services/seam_finding/referee/constants.hpp"
#include "services/seam_finding/referee/contradictions.hpp"

namespace arcstart::seam_finding {
namespace {

// What a stripe shows around the corner.
struct AroundCorner {
  double nearest = std::numeric_limits<double>::infinity();  // to the seam's line; mm
  std::vector<double> radii;  // of the arc through each point off both planes; mm
};

// Of the circle that touches both planes and goes through a point so far from them, on the corner's
// side: taken for square to each other, as a corner's plates nearly are.
double radius_through(double first, double second) {
  return first + second + std::sqrt(2 * first * second);
}

// Quartile to quartile.
double spread_of(std::vector<double>& radii) {
  return upper_quantile(radii, 0.75) - upper_quantile(radii, 0.25);
}

}  // namespace

std::optional<double> corner_radius(const ScanCloud& cloud, const std::vector<int>& points,
                                    const SeamResult& seam, double tolerance) {
  const double length = (seam.end - seam.start).norm();
  // An outside corner is rounded behind both planes, a root filled before them.
  const double side = is_outside_corner(seam) ? -1 : 1;
  std::vector<AroundCorner> stripes(cloud.stripes.size());
  for (const int i : points) {
    const Eigen::Vector3d from_start = cloud.points[i] - seam.start;
    const double along = seam.direction.dot(from_start);
    const double off = (from_start - along * seam.direction).norm();
    if (along < 0 || along > length || off > kModel.widest_round) continue;
    AroundCorner& stripe = stripes[cloud.origins[i].stripe];
    stripe.nearest = std::min(stripe.nearest, off);
    const double first = side * seam.faces[0].plane.signed_distance(cloud.points[i]),
                 second = side * seam.faces[1].plane.signed_distance(cloud.points[i]);
    if (first > tolerance && second > tolerance)
      stripe.radii.push_back(radius_through(first, second));
  }
  int seen = 0;
  std::vector<double> radii;
  for (AroundCorner& stripe : stripes) {
    if (!std::isfinite(stripe.nearest)) continue;
    ++seen;
    if (stripe.radii.empty()) continue;
    const double radius = median(stripe.radii);
    // An arc has one radius; where the plates' edges leave a notch, each place shows another.
    if (spread_of(stripe.radii) > kReferee.one_radius * radius) continue;
    if (stripe.nearest > kReferee.round_clearance * radius) radii.push_back(radius);
  }
  if (static_cast<int>(radii.size()) < kModel.stripes_in_a_row ||
      static_cast<double>(radii.size()) < kReferee.shown_share * seen)
    return std::nullopt;
  const double radius = median(radii);
  if (spread_of(radii) > kReferee.one_radius * radius) return std::nullopt;
  // The light of both plates mingles in a root, and rounds it.
  if (!is_outside_corner(seam) && radius < kReferee.least_root) return std::nullopt;
  return radius;
}

}  // namespace arcstart::seam_finding
