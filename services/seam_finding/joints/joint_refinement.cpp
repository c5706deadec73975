#include "services/seam_finding/joints/joint_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "services/seam_finding/cloud/outliers.hpp"
#include "services/seam_finding/coverage/coverage.hpp"
#include "services/seam_finding/fit/plane_fit.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/edges/strips_at_seam.hpp"
#include "services/seam_finding/planes/robust_plane.hpp"

namespace arcstart::seam_finding {
namespace {

std::vector<int> beside(const ScanCloud& cloud, const Joint& joint, int plate, double distance,
                        double tolerance) {
  const double bend = std::max(kJoints.bend_width, 2 * tolerance);
  const double from = joint.coverage.begin - kJoints.overhang,
               to = joint.coverage.end + kJoints.overhang;
  const Plane& other = joint.plates[1 - plate].plane;
  std::vector<int> points;
  points.reserve(joint.plates[plate].points.size());
  for (const int i : joint.plates[plate].points) {
    const Eigen::Vector3d& point = cloud.points[i];
    const Eigen::Vector3d p = point - joint.line.point;
    const double t = joint.line.direction.dot(p);
    if (cloud.origins[i].segment_end || t < from || t > to ||
        std::abs(other.signed_distance(point)) < bend ||
        p.squaredNorm() - t * t > distance * distance)
      continue;
    points.push_back(i);
  }
  return points;
}

// Stripes are far apart and their points may be dense: neighbours need not be sought so far then.
double outlier_spacing(const ScanCloud& cloud, const std::vector<int>& points, double spacing) {
  if (points.size() < 3) return spacing;
  PlaneSums sums(cloud.points[points.front()]);
  for (const int i : points) sums.add(cloud.points[i]);
  const Eigen::Vector2d spread = sums.fit().spread;
  const double area = 12 * spread[0] * spread[1];  // of a rectangle with that spread
  return std::min(spacing, 2 * std::sqrt(area / static_cast<double>(points.size())));
}

// Both rising.
std::vector<int> difference(const std::vector<int>& points, const std::vector<int>& without) {
  if (without.empty()) return points;
  std::vector<int> left;
  left.reserve(points.size());
  std::set_difference(points.begin(), points.end(), without.begin(), without.end(),
                      std::back_inserter(left));
  return left;
}

// The plate's points, and those next to them in their stripe that lie on it before the other plate:
// where it was laid out another plane may have taken them. Rising.
std::vector<int> grown_along_stripes(const ScanCloud& cloud, const JointPlate& plate,
                                     const JointPlate& other, double tolerance) {
  std::vector<int> grown;
  grown.reserve(plate.points.size());
  const auto goes_on = [&](int i, int from) {
    return i >= 0 && i < cloud.size() && cloud.origins[i].stripe == cloud.origins[from].stripe &&
           cloud.origins[i].segment == cloud.origins[from].segment &&
           std::abs(plate.plane.signed_distance(cloud.points[i])) <= tolerance &&
           other.plane.signed_distance(cloud.points[i]) > tolerance;
  };
  const std::vector<int>& points = plate.points;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    for (end = begin + 1; end < points.size() && points[end] == points[end - 1] + 1;) ++end;
    const int taken = grown.empty() ? -1 : grown.back();
    const int next = end < points.size() ? points[end] : cloud.size();
    int first = points[begin], last = points[end - 1];
    while (first - 1 > taken && goes_on(first - 1, points[begin])) --first;
    while (last + 1 < next && goes_on(last + 1, points[end - 1])) ++last;
    const auto place = static_cast<std::ptrdiff_t>(grown.size());
    grown.resize(grown.size() + static_cast<std::size_t>(last - first + 1));
    std::iota(grown.begin() + place, grown.end(), first);
  }
  return grown;
}

// Both rising.
void add(const std::vector<int>& more, std::vector<int>& points) {
  std::vector<int> all;
  all.reserve(points.size() + more.size());
  std::set_union(points.begin(), points.end(), more.begin(), more.end(), std::back_inserter(all));
  points = std::move(all);
}

// False where the planes do not cross.
bool set_planes(const ScanCloud& cloud, Joint& joint, const std::array<Plane, 2>& planes,
                const Scales& scales) {
  const auto line = intersect(planes[0], planes[1],
                              joint.line.at((joint.coverage.begin + joint.coverage.end) / 2));
  if (!line) return false;
  joint.plates[0].plane = planes[0];
  joint.plates[1].plane = planes[1];
  const bool along = line->direction.dot(joint.line.direction) > 0;
  joint.line = {line->point, along ? line->direction : Eigen::Vector3d(-line->direction)};
  joint.angle = open_angle(joint);
  if (cloud.organised())
    for (int j = 0; j < 2; ++j) {
      joint.plates[j].points =
          grown_along_stripes(cloud, joint.plates[j], joint.plates[1 - j], scales.tolerance);
      if (joint.type != JointType::kOutsideCorner)
        add(strips_at_seam(cloud, joint.plates[j], joint.plates[1 - j], scales.tolerance),
            joint.plates[j].points);
    }
  joint.coverage = find_coverage(cloud, joint.plates, joint.line, scales);
  return joint.coverage.stripes > 0;
}

}  // namespace

Joint refined(const ScanCloud& cloud, Joint joint, const RefinementPasses& passes,
              const Scales& scales, const SeamFindingSettings& settings) {
  std::array<std::vector<int>, 2> outliers;
  for (int pass = 0; pass < passes.count; ++pass) {
    std::array<Plane, 2> planes;
    for (int plate = 0; plate < 2; ++plate) {
      const auto chosen = beside(cloud, joint, plate, settings.refit_distance_mm, scales.tolerance);
      // Of more points than a sample they are sought in the first pass alone.
      if (passes.drop_outliers && settings.outlier_neighbours > 0 &&
          (pass == 0 || chosen.size() <= kCloud.sample))
        outliers[plate] =
            difference(chosen, without_outliers(cloud, chosen, settings.outlier_neighbours,
                                                settings.outlier_deviations,
                                                outlier_spacing(cloud, chosen, scales.spacing)));
      planes[plate] = robust_plane(cloud, difference(chosen, outliers[plate]), joint.line,
                                   joint.plates[plate].plane, scales.noise);
    }
    if (!set_planes(cloud, joint, planes, scales)) break;
  }
  return joint;
}

}  // namespace arcstart::seam_finding
