#include "services/seam_finding/joints/edges/gap_floor.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "services/seam_finding/fit/order_statistics.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/parallel_joint_type.hpp"

namespace arcstart::seam_finding {
namespace {

// Below the lower one of the plates' tops; mm.
double depth_of(const Joint& joint, const Eigen::Vector3d& point) {
  return -std::max(joint.plates[0].plane.signed_distance(point),
                   joint.plates[1].plane.signed_distance(point));
}

// What stripes show between the plates, and how far down the sight into such a gap would go, before
// it falls on the farther plate's cut; mm.
struct SeenBetween {
  std::vector<double> depths, farthest;
};
SeenBetween seen_between(const ScanCloud& cloud, const Joint& joint, double near_mm) {
  const std::array<Line, 2>& edges = joint.parallel->edges;
  const Eigen::Vector3d& across = joint.plates[1].away;
  const Eigen::Vector3d& normal = joint.plates[0].plane.normal;
  const double width = across.dot(edges[1].at(edges[1].along(edges[0].point)) - edges[0].point);
  SeenBetween seen;
  for (int i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d& p = cloud.points[i];
    const double along = joint.line.along(p);
    if (along < joint.coverage.begin || along > joint.coverage.end ||
        across.dot(p - edges[0].at(edges[0].along(p))) < 0 ||
        across.dot(p - edges[1].at(edges[1].along(p))) > 0)
      continue;
    const double depth = depth_of(joint, p);
    if (depth < near_mm) continue;
    const Eigen::Vector3d sight = cloud.seen_from(i) - p;
    seen.depths.push_back(depth);
    seen.farthest.push_back(width * normal.dot(sight) /
                            std::max(std::abs(across.dot(sight)), kJoints.least_gap_sight));
  }
  return seen;
}

// Of the background beside the joint, below the plates; mm, 0 where none is seen.
double background_depth(const ScanCloud& cloud, const Segmentation& segmentation,
                        const Joint& joint) {
  std::vector<double> depths;
  for (const int i : segmentation.background) {
    const double along = joint.line.along(cloud.points[i]);
    if (along > joint.coverage.begin && along < joint.coverage.end)
      depths.push_back(depth_of(joint, cloud.points[i]));
  }
  return median(depths);
}

}  // namespace

bool is_line_in_plate(const ScanView& scan, const Joint& joint, const Scales& scales) {
  const ScanCloud& cloud = scan.points_for(Stage::kMeasure);
  const double near = near_plate(scales);
  SeenBetween seen = seen_between(cloud, joint, near);
  if (std::ssize(seen.depths) < kModel.stripes_in_a_row) return false;
  const double floor = upper_quantile(seen.depths, 0.75), farthest = median(seen.farthest);
  const auto on_floor = std::count_if(seen.depths.begin(), seen.depths.end(),
                                      [&](double depth) { return std::abs(depth - floor) < near; });
  return floor < kJoints.shallow * farthest && 2 * on_floor > std::ssize(seen.depths) &&
         2 * floor < background_depth(cloud, scan.segmentation(Stage::kMeasure), joint);
}

}  // namespace arcstart::seam_finding
