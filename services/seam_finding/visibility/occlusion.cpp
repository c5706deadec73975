#include "services/seam_finding/visibility/occlusion.hpp"

#include <algorithm>
#include <cmath>

#include "services/seam_finding/visibility/constants.hpp"
#include "services/seam_finding/visibility/plate_stripes.hpp"

namespace arcstart::seam_finding {
namespace {

// Points of a stripe before both plates.
int points_before(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates, const Line& line,
                  const ScanStripe& stripe) {
  int before = 0;
  for (int i = stripe.first; i < stripe.first + stripe.count; ++i)
    before += plates[0].plane.signed_distance(cloud.points[i]) > kVisibility.stands_before &&
              plates[1].plane.signed_distance(cloud.points[i]) > kVisibility.stands_before &&
              line.distance(cloud.points[i]) < kVisibility.before_reach;
  return before;
}

// Points seen through where a plate is missing.
int points_past(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates, const Line& line,
                const Stations& stations, const Station& station, double tolerance) {
  const ScanStripe& stripe = cloud.stripes[station.stripe];
  std::array<int, 2> past{};
  for (int i = stripe.first; i < stripe.first + stripe.count; ++i) {
    for (int j = 0; j < 2; ++j) {
      if (station.nearest[j] <= stations.near[j]) continue;
      const auto through = seen_through(cloud, plates[j].plane, i, 2 * tolerance);
      if (!through) continue;
      const double r = away_from_seam(plates[j], plates[1 - j]).dot(*through - line.point);
      past[j] += r > kVisibility.near_seam && r < kModel.beside_seam;
    }
  }
  return std::max(past[0], past[1]);
}

}  // namespace

bool occluded_between(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                      const Line& line, const Stations& stations, int from, int to,
                      double tolerance) {
  int stripes = 0, hidden = 0, past = 0;
  for (int k = from + 1; k < to; ++k) {
    const Station& station = stations.list[k];
    if (station.stripe < 0) return false;
    if (!station.known || stations.both(station)) continue;
    ++stripes;
    past += points_past(cloud, plates, line, stations, station, tolerance) >= kModel.sure_points;
    hidden +=
        points_before(cloud, plates, line, cloud.stripes[station.stripe]) >= kModel.sure_points;
  }
  return hidden > 0 && (past == 0 || (past == 1 && stripes >= kVisibility.lone_reflection));
}

}  // namespace arcstart::seam_finding
