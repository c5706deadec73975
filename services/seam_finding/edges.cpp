#include "services/seam_finding/edges.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace arcstart {
namespace {

constexpr double kSquareCut =
    0.01;                        // standard deviation of an edge's slope; mm along for each mm away
constexpr double kAgree = 0.35;  // places on one edge, along the seam; mm
constexpr double kLeastNoise = 0.03;  // of a place along the seam, standard deviation; mm
constexpr int kPriorPlaces = 2;       // with that noise, in the estimate of the noise
constexpr double kFloor = 0.02;       // of an edge, whatever the number of its places; mm
// A stripe's last centre lies before the edge by `shortening_px`, square to it: by so much more or
// less each, and all of an edge together, for light ends over edges in many ways; px.
// The more, the flatter a stripe crosses the edge: its light fades slowly then.
constexpr double kEndDeviation = 0.2, kShorteningDeviation = 0.1;
constexpr double kFlatCrossing = 0.3;  // along the seam for each mm of the stripe
constexpr double kFlatDeviation = 8;   // px for each so much less
// Odds that plates are cut flush (3 to 7), times the way over which others' edges scatter about
// each other (13), over the root of 2 pi; mm.
constexpr double kFlushOdds = 2.3;
constexpr int kSharpBeyond = 2;          // places
constexpr double kOutlier = 3;           // standard deviations
constexpr double kNormalMedian = 1.483;  // standard deviation over the median of absolute values
constexpr double kNearSeam = 3;          // of it stripes turn into the other plate; mm
constexpr double kFarEdge = 3;  // a stripe that ends so near the plate's far edge ends there; mm
constexpr double kLeastDrop = 0.5;  // between points on a cut; mm
constexpr int kMostOnCut = 20;      // points
constexpr double kCutSlant = 0.15;  // of a cut, mm along the seam for each mm of its depth
constexpr double kCutNoise = 0.07;  // of a cut's place along the seam; mm
constexpr double kBeam = 0.5;  // of a point's noise across its surface what it is along the seam
constexpr double kChord = 3;   // over which a stripe's direction is taken; mm
constexpr std::size_t kSteps = 64;    // tell the usual one
constexpr double kLeastSight = 0.1;   // sine of the angle between a line of sight and a plate
constexpr double kLeastSlant = 0.05;  // of a stripe, mm along the seam for each mm of its length

// Where a stripe leaves the plate.
struct Place {
  double along = 0, away = 0;  // mm
  double deviation = 0;        // of along, for want of resolution alone; mm
  double pixel = 0;    // what a pixel square to the edge is along the seam; mm, at a segment's end
  bool sharp = false;  // a segment ends there, or turns over the edge
  bool occluded = false;
};

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
  for (std::size_t i = 1; i < run.size(); i += 1 + run.size() / kSteps)
    steps.push_back((cloud.points[run[i]] - cloud.points[run[i - 1]]).norm());
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

// Where along the seam the cut is over whose edge the stripe turns, from its next points: a cut is
// square to the plate, so that what lies on it lies at the edge.
std::optional<double> cut_beyond(const ScanCloud& cloud, const JointPlate& plate, const Line& line,
                                 int last, bool at_back, const EdgeSearch& search) {
  const int step = at_back ? 1 : -1;
  double sum = 0, first_along = 0, first_depth = 0;
  for (int k = 1; k <= kMostOnCut; ++k) {
    const int i = last + k * step;
    if (i < 0 || i >= cloud.size() || cloud.origins[i].stripe != cloud.origins[last].stripe ||
        cloud.origins[i].segment != cloud.origins[last].segment)
      break;
    const double along = line.along(cloud.points[i]);
    const double depth = -plate.plane.signed_distance(cloud.points[i]);
    if (k == 1) first_along = along, first_depth = depth;
    sum += along;
    const double drop = depth - first_depth;
    if (drop < kLeastDrop) continue;
    if (std::abs(along - first_along) > kCutSlant * drop + kOutlier * kBeam * search.noise) break;
    return sum / k;
  }
  return std::nullopt;
}

// Where the light at a segment's end lies. Of a stripe that is cut off at a slant the last of the
// light lies beside the laser's plane, but on the plate it does lie: where the line of sight meets
// it.
std::optional<Eigen::Vector3d> on_plate(const ScanCloud& cloud, const JointPlate& plate, int i) {
  const Eigen::Vector3d& eye = cloud.seen_from(i);
  const Eigen::Vector3d sight = cloud.points[i] - eye;
  const double toward = -plate.plane.normal.dot(sight.normalized());
  if (toward < kLeastSight) return std::nullopt;
  return cloud.points[i] +
         sight.normalized() * (plate.plane.signed_distance(cloud.points[i]) / toward);
}

// Way along the seam that shifts an edge square to it by a pixel in the image; mm. A pixel is known
// from the centre next to the segment's end: so many pixels lie between as steps.
double pixel_along(const ScanCloud& cloud, int end, int next, const Line& line,
                   const Eigen::Vector3d& away) {
  const Eigen::Vector3d& eye = cloud.seen_from(end);
  const Eigen::Vector3d sight = cloud.points[end] - eye, beside = cloud.points[next] - eye;
  const double way = (beside - sight).norm();
  if (!(way > 0)) return 0;
  const double angle =
      std::atan2(sight.cross(beside).norm(), sight.dot(beside)) * cloud.origins[end].step / way;
  const double across = std::abs(sight.cross(away).normalized().dot(line.direction));
  return across > kLeastSight ? angle * sight.norm() / across : 0;
}

std::optional<Place> place_of(const ScanCloud& cloud, const std::vector<int>& run,
                              const PlateStripes& stripes, SeamSide side,
                              const EdgeSearch& search) {
  if (run.size() < 3) return std::nullopt;
  const JointPlate& plate = stripes.plate;
  const Line& line = stripes.line;
  const bool rising = line.along(cloud.points[run.back()]) > line.along(cloud.points[run.front()]);
  const bool at_back = rising == (side == SeamSide::kEnd);
  const int last = at_back ? run.back() : run.front();
  const int beyond = at_back ? last + 1 : last - 1;
  const ScanStripe& stripe = cloud.stripes[cloud.origins[last].stripe];
  const bool more = beyond >= stripe.first && beyond < stripe.first + stripe.count;
  const bool joined = more && cloud.origins[beyond].segment == cloud.origins[last].segment;
  if (joined && std::abs(plate.plane.signed_distance(cloud.points[beyond])) <= search.tolerance)
    return std::nullopt;  // the plate goes on
  // Through the seam to the other plate.
  if (joined &&
      std::binary_search(stripes.other.points.begin(), stripes.other.points.end(), beyond))
    return std::nullopt;

  const Eigen::Vector3d direction = direction_at_end(cloud, run, at_back);
  const double slant = std::abs(direction.dot(line.direction));
  if (slant < kLeastSlant) return std::nullopt;
  const double outward = side == SeamSide::kEnd ? 1 : -1;
  Place place;
  if (cloud.origins[last].segment_end) {
    // Known to a centre.
    const auto point = on_plate(cloud, plate, last);
    if (!point) return std::nullopt;
    const int inner = at_back ? run[run.size() - 2] : run[1];
    place.pixel = pixel_along(cloud, last, inner, line, stripes.away);
    place.along = line.along(*point) + outward * search.shortening_px * place.pixel;
    place.away = stripes.away.dot(*point - line.point);
    const double end = kEndDeviation + kFlatDeviation * std::max(0.0, kFlatCrossing - slant);
    place.deviation = std::hypot(end * place.pixel, kBeam * search.noise);
    place.sharp = true;
  } else {
    // A segment that runs on turns at the plate's edge into the cut, if the cut is in sight; else
    // the plate ends between two of the points that are left.
    const double step = thinned_step(cloud, run);
    const auto cut = cut_beyond(cloud, plate, line, last, at_back, search);
    const Eigen::Vector3d point = cloud.points[last] + 0.5 * step * direction;
    place.along = cut ? *cut : line.along(point);
    place.away = stripes.away.dot(point - line.point);
    place.deviation =
        cut ? std::hypot(kCutNoise, kBeam * search.noise) : slant * step / std::sqrt(12.0);
    place.sharp = cut.has_value();
  }
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

// The median; of an even number the upper of the two in the middle.
template <class Value>
double middle_of(const std::vector<Place>& places, Value value) {
  std::vector<double> values;
  for (const Place& place : places) values.push_back(value(place));
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Places of one edge; several that are sharp tell a plate's edge also where it was not expected.
std::vector<Place> largest_agreement(const std::vector<Place>& places, const EdgeSearch& search) {
  std::vector<Place> best;
  double most = 0;
  for (const Place& one : places) {
    if (one.along < search.from - search.beyond || one.along > search.to + search.beyond) continue;
    std::vector<Place> together;
    double weight = 0;
    int sharp = 0;
    for (const Place& other : places) {
      const double allowed = kAgree + 2 * std::hypot(kSquareCut * (one.away - other.away),
                                                     one.deviation, other.deviation);
      if (std::abs(one.along - other.along) > allowed) continue;
      together.push_back(other);
      weight += kAgree / (kAgree + other.deviation);
      sharp += other.sharp;
    }
    const bool expected = one.along >= search.from && one.along <= search.to;
    if ((expected || sharp >= kSharpBeyond) && weight > most)
      most = weight, best = std::move(together);
  }
  return best;
}

}  // namespace

std::optional<PlateEdge> find_edge(const ScanCloud& cloud, const PlateStripes& stripes,
                                   SeamSide side, const EdgeSearch& search) {
  std::vector<Place> places;
  // What lies farther from the seam is the plate's other edge, along the seam.
  const double far = stripes.reach - kFarEdge;
  for (const auto& run : stripes.runs)
    if (const auto place = place_of(cloud, run, stripes, side, search))
      if (place->away < far && (place->sharp || place->away > kNearSeam)) places.push_back(*place);
  std::vector<Place> on_edge = largest_agreement(places, search);
  // What is seen of the plate before something else tells no more than that it reaches so far.
  const auto clear = [](const Place& place) { return place.sharp && !place.occluded; };
  if (2 * std::count_if(on_edge.begin(), on_edge.end(), clear) >=
      static_cast<std::ptrdiff_t>(on_edge.size()))
    std::erase_if(on_edge, [](const Place& place) { return place.occluded; });
  // A lone stripe that ends beside the seam, or cannot be seen to, ends for another reason.
  if (on_edge.size() == 1 && (on_edge[0].away <= kNearSeam || !on_edge[0].sharp))
    return std::nullopt;

  if (on_edge.empty()) return std::nullopt;

  // From the middle place on, so that one that is off draws no edge to it.
  EdgeFit fit{middle_of(on_edge, [](const Place& place) { return place.along; }), 0, 0};
  for (int pass = 0; pass < 3; ++pass) {
    const auto off = [&fit](const Place& place) {
      return std::abs(place.along - fit.at_seam - fit.slope * place.away);
    };
    const double spread = kNormalMedian * middle_of(on_edge, off),
                 known = middle_of(on_edge, [](const Place&place) { return place.deviation; });
    const auto count = static_cast<double>(on_edge.size());
    const double noise = std::sqrt((kPriorPlaces * kLeastNoise * kLeastNoise +
                                    count * std::max(0.0, spread * spread - known * known)) /
                                   (kPriorPlaces + count - 1));
    std::erase_if(on_edge, [&](const Place& place) {
      return off(place) > kOutlier * std::sqrt(variance_of(place, noise));
    });
    if (on_edge.empty()) return std::nullopt;
    fit = fit_edge(on_edge, noise);
  }
  PlateEdge edge;
  edge.along = fit.at_seam;
  const auto mean = [&on_edge](double Place::*value) {
    double sum = 0;
    for (const Place& place : on_edge) sum += place.*value;
    return sum / static_cast<double>(on_edge.size());
  };
  edge.away = mean(&Place::away);
  edge.variance =
      fit.variance + kFloor * kFloor + std::pow(kShorteningDeviation * mean(&Place::pixel), 2);
  edge.stripes = static_cast<int>(on_edge.size());
  const auto occluded =
      std::count_if(on_edge.begin(), on_edge.end(), [](const Place& p) { return p.occluded; });
  edge.occluded = 2 * occluded > edge.stripes;
  if (std::count_if(on_edge.begin(), on_edge.end(), clear) > 1)
    edge.clear_to =
        std::max_element(on_edge.begin(), on_edge.end(), [](const Place& a, const Place& b) {
          return a.away < b.away;
        })->away;
  return edge;
}

bool cut_flush(const PlateEdge& a, const PlateEdge& b) {
  const double variance = a.variance + b.variance, odds = kFlushOdds / std::sqrt(variance);
  return odds > 1 && std::pow(a.along - b.along, 2) < 2 * std::log(odds) * variance;
}

}  // namespace arcstart
