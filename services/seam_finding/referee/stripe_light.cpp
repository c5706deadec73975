#include "services/seam_finding/referee/stripe_light.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// In the tool's frame, evenly taken.
std::vector<Eigen::Vector3d> sample(const ScanCloud& cloud) {
  std::vector<Eigen::Vector3d> points;
  const std::size_t every = 1 + cloud.points.size() / kReferee.sample;
  for (std::size_t i = 0; i < cloud.points.size(); i += every) {
    const ScanStripe& stripe = cloud.stripes[cloud.origins[i].stripe];
    points.push_back(stripe.tool_turn.conjugate() * (cloud.points[i] - stripe.tool_position));
  }
  return points;
}

// By a fit of its own: what found the seam is not to vouch for itself. Nothing where they lie on a
// line.
std::optional<Plane> plane_through(const std::vector<Eigen::Vector3d>& points) {
  if (points.size() < 3) return std::nullopt;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) scatter += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const double width = std::sqrt(solver.eigenvalues()(1) / static_cast<double>(points.size()));
  if (!(width > kReferee.light_width)) return std::nullopt;
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return Plane{normal, -normal.dot(mean)};
}

// Without the points that lie off it, as outliers of a cloud from elsewhere may.
std::optional<Plane> robust_plane(std::vector<Eigen::Vector3d> points) {
  std::optional<Plane> plane = plane_through(points);
  std::vector<double> distances;
  for (int pass = 0; plane && pass < 2; ++pass) {
    distances.clear();
    for (const Eigen::Vector3d& p : points)
      distances.push_back(std::abs(plane->signed_distance(p)));
    const double farthest = std::max(kReferee.light_width,
                                     kFit.on_plane * kFit.median_to_deviation * median(distances));
    std::erase_if(points, [&](const Eigen::Vector3d& p) {
      return std::abs(plane->signed_distance(p)) > farthest;
    });
    plane = plane_through(points);
  }
  return plane;
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
