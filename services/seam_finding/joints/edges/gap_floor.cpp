#include "services/seam_finding/joints/edges/gap_floor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/order_statistics.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/parallel_joint_type.hpp"

namespace arcstart::seam_finding {
namespace {

// Below the lower one of the plates' tops; mm.
double depth_of(const Joint& joint, const Eigen::Vector3d& point) {
  return -std::max(joint.plates[0].plane.signed_distance(point),
                   joint.plates[1].plane.signed_distance(point));
}

// What stripes show below both tops, between the plates and beside their edges: told by a floor,
// these lie nearer to each other than the line is wide.
std::vector<std::pair<double, double>> seen_between(const ScanCloud& cloud, const Joint& joint,
                                                    double near_mm) {
  const std::array<Line, 2>& edges = joint.parallel->edges;
  const Eigen::Vector3d& across = joint.plates[1].away;
  std::vector<std::pair<double, double>> seen;  // across, depth; mm
  for (const Eigen::Vector3d& p : cloud.points) {
    const double along = joint.line.along(p);
    if (along < joint.coverage.begin || along > joint.coverage.end) continue;
    const double from_first = across.dot(p - edges[0].at(edges[0].along(p)));
    if (from_first < -kJoints.floor_beside ||
        across.dot(p - edges[1].at(edges[1].along(p))) > kJoints.floor_beside)
      continue;
    if (const double depth = depth_of(joint, p); depth >= near_mm)
      seen.emplace_back(from_first, depth);
  }
  return seen;
}

// Of the background beside the joint, below the plates; mm, 0 where none is seen. Where it lies
// nearest to them: plates may be tilted, and a table have slots.
double background_depth(const ScanCloud& cloud, const Segmentation& segmentation,
                        const Joint& joint) {
  std::vector<double> depths;
  for (const int i : segmentation.background) {
    const double along = joint.line.along(cloud.points[i]);
    if (along > joint.coverage.begin && along < joint.coverage.end)
      depths.push_back(depth_of(joint, cloud.points[i]));
  }
  return quantile(depths, 0.1);
}

}  // namespace

bool shows_floor_near_top(const ScanView& scan, const Joint& joint, const Scales& scales) {
  const auto seen = seen_between(scan.points_for(Stage::kMeasure), joint, near_plate(scales));
  std::vector<double> depths, places;
  for (const auto& [across, depth] : seen) depths.push_back(depth);
  const double floor = upper_quantile(depths, 0.75);
  for (const auto& [across, depth] : seen)
    if (std::abs(depth - floor) < kJoints.least_near) places.push_back(across);
  if (std::ssize(places) < kModel.stripes_in_a_row || 2 * places.size() < seen.size()) return false;
  const double width = quantile(places, 0.9) - quantile(places, 0.1);
  return width > kFit.on_plane * kJoints.cut_deviation &&
         2 * floor < background_depth(scan.points_for(Stage::kMeasure),
                                      scan.segmentation(Stage::kMeasure), joint);
}

}  // namespace arcstart::seam_finding
