#include "services/seam_finding/referee/stripe_light.hpp"

#include <algorithm>
#include <cmath>

#include "services/seam_finding/cloud/constants.hpp"
#include "services/seam_finding/fit/order_statistics.hpp"
#include "services/seam_finding/fit/plane_fit.hpp"
#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// In the tool's frame, evenly taken.
std::vector<Eigen::Vector3d> sample(const ScanCloud& cloud) {
  std::vector<Eigen::Vector3d> points;
  const std::size_t every = 1 + cloud.points.size() / kCloud.sample;
  for (std::size_t i = 0; i < cloud.points.size(); i += every) {
    const ScanStripe& stripe = cloud.stripes[cloud.origins[i].stripe];
    points.push_back(stripe.tool_turn.conjugate() * (cloud.points[i] - stripe.tool_position));
  }
  return points;
}

// Without the points that lie off it, as outliers of a cloud from elsewhere may. Nothing where they
// lie on a line.
std::optional<Plane> robust_plane(std::vector<Eigen::Vector3d> points) {
  std::vector<double> distances;
  for (int pass = 0; !points.empty(); ++pass) {
    PlaneSums sums(points.front());
    for (const Eigen::Vector3d& p : points) sums.add(p);
    const PlaneSums::Fit fit = sums.fit();
    if (!(fit.spread[0] > kReferee.light_width)) break;
    if (pass == 2) return fit.plane;
    distances.clear();
    for (const Eigen::Vector3d& p : points)
      distances.push_back(std::abs(fit.plane.signed_distance(p)));
    const double farthest = std::max(kReferee.light_width,
                                     kFit.on_plane * kFit.median_to_deviation * median(distances));
    std::erase_if(points, [&](const Eigen::Vector3d& p) {
      return std::abs(fit.plane.signed_distance(p)) > farthest;
    });
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::optional<StripeLight>> light_of(const ScanCloud& cloud) {
  const auto in_tool = robust_plane(sample(cloud));
  if (!in_tool) return {};
  std::vector<std::optional<StripeLight>> lights;
  for (const ScanStripe& stripe : cloud.stripes) {
    lights.emplace_back();
    if (stripe.count == 0) continue;
    StripeLight light;
    light.plane.normal = stripe.tool_turn * in_tool->normal;
    light.plane.offset = in_tool->offset - light.plane.normal.dot(stripe.tool_position);
    light.source = stripe.camera_centre -
                   light.plane.signed_distance(stripe.camera_centre) * light.plane.normal;
    lights.back() = light;
  }
  return lights;
}

}  // namespace arcstart::seam_finding
