#include "services/seam_finding/coverage/stations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/order_statistics.hpp"
#include "services/seam_finding/coverage/constants.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// What one stripe shows of one plate beside the line.
struct Sight {
  int count = 0;
  double r = 0, t = 0, rr = 0, rt = 0;  // sums of distance from and place along the line
  double nearest = kInfinity;           // of the distances; mm
};

// What all stripes show of one plate.
struct Sights {
  std::vector<Sight> stripes;
  std::vector<double> away;  // the distances, one stripe's behind the other's; mm
};

Sights sights_of(const ScanCloud& cloud, const JointPlate& plate, const JointPlate& other,
                 const Line& line, double tolerance) {
  const Eigen::Vector3d away = away_from_seam(plate, other);
  Sights sights;
  sights.stripes.resize(cloud.stripes.size());
  sights.away.reserve(plate.points.size());
  for (const int i : plate.points) {
    const double r = away.dot(cloud.points[i] - line.point);
    if (r <= tolerance || r > plate.round + kCoverage.slant_reach)
      continue;  // either plate's, or behind the other
    const double t = line.along(cloud.points[i]);
    sights.away.push_back(r);
    Sight& s = sights.stripes[cloud.origins[i].stripe];
    ++s.count;
    s.r += r, s.t += t, s.rr += r * r, s.rt += r * t;
    s.nearest = std::min(s.nearest, r);
  }
  return sights;
}

// A stripe lies on a plate in a straight line, t = crossing + slant * r, with one slant for the
// whole scan.
double slant_of(const Sights& sights) {
  double rr = 0, rt = 0;
  for (const Sight& s : sights.stripes) {
    if (s.count < 2) continue;
    rr += s.rr - s.r * s.r / s.count;
    rt += s.rt - s.r * s.t / s.count;
  }
  return rr > 1 ? std::clamp(rt / rr, -kCoverage.steepest, kCoverage.steepest) : 0;
}

// How far from the line a plate's nearest point can be where the stripe runs on to the line: points
// nearer than the tolerance, and on a round edge, do not count, the others are a step apart, and
// one may be an outlier.
double near_limit(Sights& sights, double tolerance, const JointPlate& plate) {
  std::vector<double> steps;
  steps.reserve(sights.away.size());
  auto first = sights.away.begin();
  for (const Sight& s : sights.stripes) {
    const auto last = first + s.count;
    std::sort(first, last);
    for (; first != last; ++first)
      if (first + 1 != last) steps.push_back(*(first + 1) - *first);
  }
  if (steps.empty()) return plate.contact;
  return std::min(plate.contact,
                  plate.round + tolerance + kCoverage.steps_to_line * quantile(steps, 0.9));
}

using Places = std::vector<std::optional<double>>;

Places seen_crossings(const std::array<Sights, 2>& sights,
                      const std::array<JointPlate, 2>& plates) {
  Places places(sights[0].stripes.size());
  const std::array<double, 2> slants = {slant_of(sights[0]), slant_of(sights[1])};
  for (std::size_t k = 0; k < places.size(); ++k) {
    double sum = 0;
    int showing = 0;
    for (int j = 0; j < 2; ++j)
      if (const Sight& s = sights[j].stripes[k]; s.nearest <= plates[j].contact)
        sum += (s.t - slants[j] * s.r) / s.count, ++showing;
    if (showing > 0) places[k] = sum / showing;
  }
  return places;
}

int nearest_set(const Places& places, int from, int step) {
  for (int i = from; i >= 0 && i < static_cast<int>(places.size()); i += step)
    if (places[i]) return i;
  return -1;
}

Places carried_crossings(const ScanCloud& cloud, const Places& seen, const Line& line) {
  Places places(seen.size());
  for (int k = 0; k < static_cast<int>(seen.size()); ++k) {
    if (cloud.stripes[k].seen != ScanStripe::Seen::kSeen) continue;
    const int before = nearest_set(seen, k, -1), after = nearest_set(seen, k, +1);
    const int from = before < 0 || (after >= 0 && after - k < k - before) ? after : before;
    if (from < 0) continue;
    const Eigen::Vector3d way = cloud.stripes[k].tool_position - cloud.stripes[from].tool_position;
    places[k] = *seen[from] + line.direction.dot(way);
  }
  return places;
}

// Of a missing stripe, from its neighbours'.
double guessed_crossing(const Places& places, int k, double spacing) {
  if (places[k]) return *places[k];
  const int before = nearest_set(places, k, -1), after = nearest_set(places, k, +1);
  if (before >= 0 && after >= 0)
    return *places[before] + (*places[after] - *places[before]) * (k - before) / (after - before);
  if (before >= 0) return *places[before] + spacing * (k - before);
  return after >= 0 ? *places[after] - spacing * (after - k) : 0;
}

// One stripe that shows nothing may have been spoilt; several in a row show that nothing is there.
void mark_unknown(const ScanCloud& cloud, std::vector<Station>& stations) {
  const int count = static_cast<int>(stations.size());
  for (int k = 0; k < count;) {
    int end = k;
    while (end < count && cloud.stripes[end].seen == ScanStripe::Seen::kEmpty) ++end;
    for (int i = k; i < end; ++i) stations[i].known = end - k >= kModel.stripes_in_a_row;
    if (end < count) stations[end].known = cloud.stripes[end].seen == ScanStripe::Seen::kSeen;
    k = end + 1;
  }
}

Stations stripe_stations(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                         const Line& line, const Scales& scales) {
  std::array<Sights, 2> sights = {sights_of(cloud, plates[0], plates[1], line, scales.tolerance),
                                  sights_of(cloud, plates[1], plates[0], line, scales.tolerance)};
  const Places places = carried_crossings(cloud, seen_crossings(sights, plates), line);
  Stations found;
  for (int j = 0; j < 2; ++j) {
    found.slant[j] = slant_of(sights[j]);
    found.near[j] = near_limit(sights[j], scales.tolerance, plates[j]);
  }
  std::vector<Station>& stations = found.list;
  stations.resize(cloud.stripes.size());
  for (int k = 0; k < static_cast<int>(stations.size()); ++k)
    stations[k] = {guessed_crossing(places, k, scales.spacing),
                   {sights[0].stripes[k].nearest, sights[1].stripes[k].nearest},
                   true,
                   k};
  mark_unknown(cloud, stations);
  std::stable_sort(stations.begin(), stations.end(),
                   [](const Station& a, const Station& b) { return a.along < b.along; });
  return found;
}

// A plate goes on where its points near the line leave no wide gap.
Stations piece_stations(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                        const Line& line, const Scales& scales) {
  std::array<std::vector<double>, 2> places;
  double low = kInfinity, high = -kInfinity;
  for (int j = 0; j < 2; ++j) {
    const Eigen::Vector3d away = away_from_seam(plates[j], plates[1 - j]);
    for (const int i : plates[j].points)
      if (const double r = away.dot(cloud.points[i] - line.point);
          r > scales.tolerance && r <= plates[j].contact)
        places[j].push_back(line.along(cloud.points[i]));
    if (places[j].empty()) return {};
    std::sort(places[j].begin(), places[j].end());
    low = std::min(low, places[j].front()), high = std::max(high, places[j].back());
  }
  Stations found;
  found.near = {plates[0].contact, plates[1].contact};
  for (double t = low - scales.spacing; t <= high + scales.spacing; t += scales.spacing) {
    Station station{t, {kInfinity, kInfinity}};
    for (int j = 0; j < 2; ++j) {
      const auto after = std::lower_bound(places[j].begin(), places[j].end(), t);
      if (after != places[j].end() && after != places[j].begin() &&
          *after - *(after - 1) <= plates[j].contact)
        station.nearest[j] = 0;
    }
    found.list.push_back(station);
  }
  return found;
}

}  // namespace

Stations stations_along(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                        const Line& line, const Scales& scales) {
  return cloud.organised() ? stripe_stations(cloud, plates, line, scales)
                           : piece_stations(cloud, plates, line, scales);
}

}  // namespace arcstart::seam_finding
