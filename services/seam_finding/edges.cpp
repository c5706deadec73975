#include "services/seam_finding/edges.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace arcstart {
namespace {

constexpr double kSquareCut =
    0.01;                        // standard deviation of an edge's slope; mm along for each mm away
constexpr double kAgree = 0.35;  // places on one edge, along the seam; mm
constexpr double kAgreeSlope = 0.02;  // and so much more for each mm between them
constexpr double kLeastNoise = 0.04;  // of a place along the seam, standard deviation; mm
constexpr int kPriorPlaces = 2;       // with that noise, in the estimate of the noise
constexpr double kFloor = 0.02;       // of an edge, whatever the number of its places; mm
// Light ends over edges in many ways: of the shortening, common to an edge; px.
constexpr double kShorteningDeviation = 1;
constexpr double kOutlier = 3;   // standard deviations
constexpr double kNearSeam = 3;  // of it stripes turn into the other plate; mm
constexpr double kFarEdge = 3;   // a stripe that ends so near the plate's far edge ends there; mm
constexpr double kLeastDrop = 0.5;    // between points on a cut; mm
constexpr double kCornerSlack = 0.5;  // mm
constexpr double kCornerNoise = 0.3;  // along the stripe; mm
constexpr double kChord = 3;          // over which a stripe's direction is taken; mm
constexpr double kLeastSlant = 0.05;  // of a stripe, mm along the seam for each mm of its length

// Where a stripe leaves the plate.
struct Place {
  double along = 0, away = 0;  // mm
  double deviation = 0;        // of along, for want of resolution alone; mm
  double pixel = 0;    // what a pixel along the stripe is along the seam; mm, at a segment's end
  bool sharp = false;  // a segment ends there, or turns over the edge
  bool occluded = false;
};

// A stripe's points on the plate, on its open side, in the stripe's order.
std::vector<std::vector<int>> points_by_stripe(const ScanCloud& cloud, const JointPlate& plate,
                                               const Line& line, const Eigen::Vector3d& away,
                                               double tolerance) {
  std::vector<std::vector<int>> stripes(cloud.stripes.size());
  for (const int i : plate.points)
    if (away.dot(cloud.points[i] - line.point) > tolerance &&
        std::abs(plate.plane.signed_distance(cloud.points[i])) <= tolerance)
      stripes[cloud.origins[i].stripe].push_back(i);
  return stripes;
}

// Which way a stripe runs there, out of the plate; from points far enough apart for their noise.
Eigen::Vector3d direction_at_end(const ScanCloud& cloud, const std::vector<int>& run,
                                 bool at_back) {
  const Eigen::Vector3d& last = cloud.points[at_back ? run.back() : run.front()];
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i < run.size() && way.norm() < kChord; ++i)
    way = last - cloud.points[at_back ? run[run.size() - 1 - i] : run[i]];
  return way.norm() > 1e-6 ? way.normalized() : way;
}

// The usual way between the points that are left of a stripe.
double thinned_step(const ScanCloud& cloud, const std::vector<int>& run) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < run.size(); ++i)
    steps.push_back((cloud.points[run[i]] - cloud.points[run[i - 1]]).norm());
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

// Where the stripe turns over the plate's edge into the cut: the line through its next two points
// meets the plate there.
std::optional<Eigen::Vector3d> corner_beyond(const ScanCloud& cloud, const JointPlate& plate,
                                             int last, bool at_back,
                                             const Eigen::Vector3d& direction, double step) {
  const int one = at_back ? last + 1 : last - 1, two = at_back ? last + 2 : last - 2;
  const auto joined = [&](int i) {
    return i >= 0 && i < cloud.size() && cloud.origins[i].stripe == cloud.origins[last].stripe &&
           cloud.origins[i].segment == cloud.origins[last].segment;
  };
  if (!joined(one) || !joined(two)) return std::nullopt;
  const Eigen::Vector3d &a = cloud.points[one], &b = cloud.points[two];
  const double below = -plate.plane.signed_distance(a), deeper = -plate.plane.signed_distance(b);
  if (deeper - below < kLeastDrop) return std::nullopt;
  const Eigen::Vector3d corner = a + (a - b) * below / (deeper - below);
  const double ahead = direction.dot(corner - cloud.points[last]);
  if (ahead < -kCornerSlack || ahead > step + kCornerSlack ||
      (corner - cloud.points[last]).norm() > step + kCornerSlack)
    return std::nullopt;
  return corner;
}

std::optional<Place> place_of(const ScanCloud& cloud, const std::vector<int>& run,
                              const JointPlate& plate, const JointPlate& other, const Line& line,
                              SeamSide side, const EdgeSearch& search) {
  if (run.size() < 3) return std::nullopt;
  const bool rising = line.along(cloud.points[run.back()]) > line.along(cloud.points[run.front()]);
  const bool at_back = rising == (side == SeamSide::kEnd);
  const int last = at_back ? run.back() : run.front();
  const int beyond = at_back ? last + 1 : last - 1;
  const ScanStripe& stripe = cloud.stripes[cloud.origins[last].stripe];
  const bool more = beyond >= stripe.first && beyond < stripe.first + stripe.count;
  const bool joined = more && cloud.origins[beyond].segment == cloud.origins[last].segment;
  // Through the seam to the other plate.
  if (joined && std::binary_search(other.points.begin(), other.points.end(), beyond))
    return std::nullopt;

  const Eigen::Vector3d direction = direction_at_end(cloud, run, at_back);
  const double slant = std::abs(direction.dot(line.direction));
  if (slant < kLeastSlant) return std::nullopt;
  // A segment's end is known to a centre. A segment that runs on turns at the plate's edge into the
  // cut, if the cut is in sight; else the plate ends between two of the points that are left.
  const bool ends = cloud.origins[last].segment_end;
  const double step = ends ? cloud.origins[last].step : thinned_step(cloud, run);
  const auto corner =
      ends ? std::nullopt : corner_beyond(cloud, plate, last, at_back, direction, step);
  const Eigen::Vector3d point =
      corner ? *corner
             : Eigen::Vector3d(cloud.points[last] +
                               (ends ? search.shortening_px : 0.5) * step * direction);
  const Eigen::Vector3d away = away_from_seam(plate, other);
  Place place;
  place.along = line.along(point);
  place.away = away.dot(point - line.point);
  place.deviation = slant * (corner ? kCornerNoise : step / std::sqrt(12.0));
  place.pixel = ends ? slant * step : 0;
  place.sharp = ends || corner;
  place.occluded = more && plate.plane.signed_distance(cloud.points[beyond]) > 2 * search.tolerance;
  return place;
}

double variance_of(const Place& place, double noise) {
  return noise * noise + place.deviation * place.deviation;
}

// along = at_seam + slope * away by weighted least squares, the slope held near zero.
struct EdgeFit {
  double at_seam = 0, slope = 0, variance = 0;
};
EdgeFit fit_edge(const std::vector<Place>& places, double noise) {
  double w = 0, r = 0, t = 0, rr = 0, rt = 0;
  for (const Place& place : places) {
    const double weight = 1 / variance_of(place, noise);
    w += weight, r += weight * place.away, t += weight * place.along;
    rr += weight * place.away * place.away, rt += weight * place.away * place.along;
  }
  rr += 1 / (kSquareCut * kSquareCut);
  const double determinant = w * rr - r * r;
  return {(t * rr - r * rt) / determinant, (w * rt - r * t) / determinant, rr / determinant};
}

std::vector<Place> largest_agreement(const std::vector<Place>& places, const EdgeSearch& search) {
  std::vector<Place> best;
  double most = 0;
  for (const Place& one : places) {
    if (one.along < search.from || one.along > search.to) continue;
    std::vector<Place> together;
    double weight = 0;
    for (const Place& other : places) {
      const double allowed = kAgree + kAgreeSlope * std::abs(one.away - other.away) +
                             2 * (one.deviation + other.deviation);
      if (std::abs(one.along - other.along) > allowed) continue;
      together.push_back(other);
      weight += kAgree / (kAgree + other.deviation);
    }
    if (weight > most) most = weight, best = std::move(together);
  }
  return best;
}

// What lies farther from the seam is the plate's other edge, along the seam: half of the stripes
// reach it.
double far_edge(const ScanCloud& cloud, const std::vector<std::vector<int>>& runs, const Line& line,
                const Eigen::Vector3d& away) {
  std::vector<double> reaches;
  for (const auto& run : runs) {
    double reach = 0;
    for (const int i : run) reach = std::max(reach, away.dot(cloud.points[i] - line.point));
    if (reach > 0) reaches.push_back(reach);
  }
  if (reaches.empty()) return 0;
  const auto middle = reaches.begin() + static_cast<std::ptrdiff_t>(reaches.size() / 2);
  std::nth_element(reaches.begin(), middle, reaches.end());
  return *middle - kFarEdge;
}

}  // namespace

std::optional<PlateEdge> find_edge(const ScanCloud& cloud, const JointPlate& plate,
                                   const JointPlate& other, const Line& line, SeamSide side,
                                   const EdgeSearch& search) {
  if (!cloud.organised()) return std::nullopt;
  const Eigen::Vector3d away = away_from_seam(plate, other);
  std::vector<Place> places;
  const auto runs = points_by_stripe(cloud, plate, line, away, search.tolerance);
  const double far = far_edge(cloud, runs, line, away);
  for (const auto& run : runs)
    if (const auto place = place_of(cloud, run, plate, other, line, side, search))
      if (place->sharp || (place->away > kNearSeam && place->away < far)) places.push_back(*place);
  std::vector<Place> on_edge = largest_agreement(places, search);
  // A lone stripe that ends beside the seam, or at the far edge, ends for another reason.
  if (on_edge.size() == 1 && !(on_edge[0].away > kNearSeam && on_edge[0].away < far))
    return std::nullopt;

  PlateEdge edge;
  for (int pass = 0; pass < 3 && !on_edge.empty(); ++pass) {
    EdgeFit fit = fit_edge(on_edge, kLeastNoise);
    double squares = kPriorPlaces * kLeastNoise * kLeastNoise;
    for (const Place& place : on_edge) {
      const double off = place.along - fit.at_seam - fit.slope * place.away;
      squares += std::max(0.0, off * off - place.deviation * place.deviation);
    }
    const double noise =
        std::sqrt(squares / (kPriorPlaces + static_cast<double>(on_edge.size()) - 1));
    fit = fit_edge(on_edge, noise);
    edge.along = fit.at_seam;
    double pixel = 0;
    for (const Place& place : on_edge) pixel += place.pixel / static_cast<double>(on_edge.size());
    edge.variance = fit.variance + kFloor * kFloor + std::pow(kShorteningDeviation * pixel, 2);
    edge.stripes = static_cast<int>(on_edge.size());
    const auto occluded =
        std::count_if(on_edge.begin(), on_edge.end(), [](const Place& p) { return p.occluded; });
    edge.occluded = 2 * occluded > edge.stripes;
    const auto outliers = std::erase_if(on_edge, [&](const Place& place) {
      return std::abs(place.along - fit.at_seam - fit.slope * place.away) >
             kOutlier * std::sqrt(variance_of(place, noise));
    });
    if (outliers == 0) break;
  }
  if (on_edge.empty()) return std::nullopt;
  return edge;
}

}  // namespace arcstart
