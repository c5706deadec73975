#include "services/seam_finding/model/scan_cloud.hpp"

#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {

void end_stripe(ScanCloud& cloud, ScanStripe::Seen seen, const Eigen::Vector3d& camera_centre,
                const Eigen::Vector3d& tool_position, const Eigen::Quaterniond& tool_turn) {
  ScanStripe stripe;
  stripe.seen = seen;
  if (!cloud.stripes.empty())
    stripe.first = cloud.stripes.back().first + cloud.stripes.back().count;
  stripe.count = cloud.size() - stripe.first;
  stripe.camera_centre = camera_centre;
  stripe.tool_position = tool_position;
  stripe.tool_turn = tool_turn;
  cloud.stripes.push_back(stripe);
}

ScanCloud unorganised_cloud(std::vector<Eigen::Vector3d> points) {
  ScanCloud cloud;
  cloud.points = std::move(points);
  cloud.origins.resize(cloud.points.size());
  return cloud;
}

std::optional<Eigen::Vector3d> search_direction(const ScanCloud& cloud) {
  if (!cloud.organised()) return cloud.search_direction;
  const ScanStripe *first = nullptr, *last = nullptr;
  for (const ScanStripe& stripe : cloud.stripes) {
    if (stripe.seen != ScanStripe::Seen::kSeen) continue;
    if (first == nullptr) first = &stripe;
    last = &stripe;
  }
  if (first == nullptr) return std::nullopt;
  const Eigen::Vector3d way = last->tool_position - first->tool_position;
  if (way.norm() < kModel.least_motion) return std::nullopt;
  return way.normalized();
}

}  // namespace arcstart::seam_finding
