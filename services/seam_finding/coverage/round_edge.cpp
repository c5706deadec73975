#include "services/seam_finding/coverage/round_edge.hpp"

#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/seam_finding/coverage/constants.hpp"

namespace arcstart::seam_finding {
namespace {

class RoundEdge {
 public:
  RoundEdge(const ScanCloud& cloud, const Plane& plane, const Plane& other, const Line& line)
      : cloud_(cloud), plane_(plane), line_(line) {
    away_ = plane.normal.cross(line.direction).normalized();
    if (away_.dot(other.normal) < 0) away_ = -away_;
  }

  double from_line(int i) const { return away_.dot(cloud_.points[i] - line_.point); }

  // By where a stripe goes on from its last point on the face: the last place behind the plane, as
  // far from the line as the circle begins that runs through it and touches both planes; 0 where it
  // does not go on so.
  double begins(int last, double tolerance) const {
    for (const int step : {1, -1}) {
      double r = from_line(last), depth = -plane_.signed_distance(cloud_.points[last]);
      for (int i = last + step; goes_on(i, last); i += step) {
        const double next_r = from_line(i), next = -plane_.signed_distance(cloud_.points[i]);
        if (next_r <= 0 || next_r >= r || next <= depth) break;
        r = next_r, depth = next;
      }
      if (depth > tolerance) return r + depth + std::sqrt(2 * r * depth);
    }
    return 0;
  }

 private:
  bool goes_on(int i, int from) const {
    return i >= 0 && i < cloud_.size() && cloud_.origins[i].stripe == cloud_.origins[from].stripe &&
           cloud_.origins[i].segment == cloud_.origins[from].segment;
  }

  const ScanCloud& cloud_;
  const Plane& plane_;
  const Line& line_;
  Eigen::Vector3d away_;
};

}  // namespace

double round_edge(const ScanCloud& cloud, const std::vector<int>& points, const Plane& plane,
                  const Plane& other, const Line& line, const Scales& scales) {
  if (!cloud.organised()) return 0;
  const RoundEdge edge(cloud, plane, other, line);
  std::vector<double> begins;
  int stripes = 0;
  for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
    std::size_t nearest = first;
    double farthest = 0;
    for (last = first; last < points.size() &&
                       cloud.origins[points[last]].stripe == cloud.origins[points[first]].stripe;
         ++last) {
      const double r = edge.from_line(points[last]);
      if (r < edge.from_line(points[nearest])) nearest = last;
      farthest = std::max(farthest, r);
    }
    const double r = edge.from_line(points[nearest]);
    if (r > kModel.widest_round) continue;
    ++stripes;
    // Of a low arc much hides behind itself: what is seen leaves the plane by less than a
    // tolerance.
    const double at = r > 0 ? edge.begins(points[nearest], scales.tolerance / 2) : 0;
    if (at > 2 * scales.tolerance && at <= kModel.widest_round && farthest - r > at)
      begins.push_back(at);
  }
  return 2 * static_cast<int>(begins.size()) > stripes ? median(begins) : 0;
}

}  // namespace arcstart::seam_finding
