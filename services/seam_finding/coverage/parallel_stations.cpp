#include "services/seam_finding/coverage/parallel_stations.hpp"

#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/seam_finding/coverage/constants.hpp"
#include "services/seam_finding/coverage/stations.hpp"

namespace arcstart::seam_finding {
namespace {

// A stripe that runs on to a plate's border has its nearest point, one more than the tolerance
// away, within a step between points; one that leaves the plate before has not.
double running_on(const ScanCloud& cloud, const JointPlate& plate, double tolerance) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < plate.points.size(); ++i) {
    const int a = plate.points[i - 1], b = plate.points[i];
    if (b == a + 1 && cloud.origins[a].stripe == cloud.origins[b].stripe &&
        cloud.origins[a].segment == cloud.origins[b].segment)
      steps.push_back((cloud.points[b] - cloud.points[a]).norm());
  }
  if (steps.empty()) return plate.contact;
  return std::min(
      plate.contact,
      tolerance + std::max(kCoverage.least_slack, kCoverage.steps_to_edge * quantile(steps, 0.9)));
}

}  // namespace

std::array<Stations, 2> stations_by_edge(const ScanCloud& cloud, const Joint& joint,
                                         const Scales& scales) {
  std::array<Stations, 2> stations;
  // Up to its border what lies on a plate is its own: no other plate's face begins there.
  Scales to_border = scales;
  to_border.tolerance = 0;
  for (int j = 0; j < 2; ++j) {
    const Line& border = joint.parallel->edges[j];
    // Of a lap the other plate lies at another height, where stripes cross elsewhere.
    std::array<JointPlate, 2> plates = joint.plates;
    plates[1 - j].points.clear();
    stations[j] = stations_along(cloud, plates, border, to_border);
    for (Station& station : stations[j].list)
      station.along = joint.line.along(border.at(station.along));
    if (cloud.organised())
      stations[j].near[j] = running_on(cloud, joint.plates[j], scales.tolerance);
  }
  return stations;
}

Stations stations_of_both(const std::array<Stations, 2>& by_border) {
  Stations both = by_border[0];
  both.near[1] = by_border[1].near[1];
  for (Station& station : both.list) {
    // The same stripe or, without stripes, the same place.
    const auto off = [&](const Station& s) {
      return station.stripe >= 0 ? std::abs(s.stripe - station.stripe)
                                 : std::abs(s.along - station.along);
    };
    const auto& others = by_border[1].list;
    const auto same =
        std::min_element(others.begin(), others.end(),
                         [&](const Station& a, const Station& b) { return off(a) < off(b); });
    if (same == others.end()) continue;
    station.nearest[1] = same->nearest[1];
    station.along = (station.along + same->along) / 2;
  }
  std::stable_sort(both.list.begin(), both.list.end(),
                   [](const Station& a, const Station& b) { return a.along < b.along; });
  return both;
}

}  // namespace arcstart::seam_finding
