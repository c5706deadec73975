#include "services/seam_finding/ends/plate_end.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "services/seam_finding/ends/constants.hpp"
#include "services/seam_finding/ends/edge_crossing.hpp"
#include "services/seam_finding/fit/order_statistics.hpp"

namespace arcstart::seam_finding {
namespace {

using Places = std::vector<EdgeCrossing>;

double variance_of(const EdgeCrossing& place, double noise) {
  return noise * noise + place.deviation * place.deviation;
}

// along = at_seam + slope * away
struct EdgeFit {
  double at_seam = 0, slope = 0, variance = 0;
};
double off_edge(const EdgeCrossing& place, const EdgeFit& fit) {
  return std::abs(place.along - fit.at_seam - fit.slope * place.away);
}

// By weighted least squares, the slope held near zero: its standard deviation.
EdgeFit fit_edge(const Places& places, double noise, double slope) {
  double w = 0, r = 0, t = 0, rr = 0, rt = 0;
  for (const EdgeCrossing& place : places) {
    const double weight = 1 / variance_of(place, noise);
    w += weight, r += weight * place.away, t += weight * place.along;
    rr += weight * place.away * place.away, rt += weight * place.away * place.along;
  }
  rr += 1 / (slope * slope);
  const double determinant = w * rr - r * r;
  return {(t * rr - r * rt) / determinant, (w * rt - r * t) / determinant, rr / determinant};
}

template <class Value>
double middle_of(const Places& places, Value value) {
  std::vector<double> values;
  values.reserve(places.size());
  for (const EdgeCrossing& place : places) values.push_back(value(place));
  return median(values);
}

// Standard deviations: of the places about an edge, and what is known of them one by one.
double spread_about(const Places& places, const EdgeFit& fit) {
  return kEnds.rounded_median_to_deviation *
         middle_of(places, [&fit](const EdgeCrossing& place) { return off_edge(place, fit); });
}
double known_to(const Places& places) {
  return middle_of(places, [](const EdgeCrossing& place) { return place.deviation; });
}

// Square to the seam through the middle place, so that one that is off draws no edge to it; at the
// middle slope of all their pairs (Theil and Sen) where enough of them tell that one plainly.
EdgeFit through_the_middle(const Places& places) {
  const EdgeFit square{middle_of(places, [](const EdgeCrossing& place) { return place.along; }), 0,
                       0};
  const double spread = spread_about(places, square);
  if (places.size() < kFit.line_places ||
      spread < kEnds.plainly * std::hypot(known_to(places), kEnds.least_place_noise))
    return square;
  std::vector<double> slopes;
  for (const EdgeCrossing& a : places)
    for (const EdgeCrossing& b : places)
      if (b.away - a.away > kEnds.direction_base)
        slopes.push_back((b.along - a.along) / (b.away - a.away));
  if (slopes.size() < places.size()) return square;
  EdgeFit askew{0, median(slopes), 0};
  askew.at_seam = middle_of(
      places, [&](const EdgeCrossing& place) { return place.along - askew.slope * place.away; });
  return kEnds.plainly * spread_about(places, askew) < spread ? askew : square;
}

struct Agreement {
  Places places;
  double weight = 0;
};

double weight_of(const EdgeCrossing& place) {
  return kEnds.agree / (kEnds.agree + place.deviation);
}

// Places of one edge; several that are sharp tell a plate's edge also where it was not expected.
Agreement largest_agreement(const Places& places, const EdgeWindow& window, double edge_slope) {
  const double most_slope = std::max(kVisibility.end_slope, edge_slope);
  Agreement best;
  for (const EdgeCrossing& one : places) {
    if (one.along < window.from - window.beyond || one.along > window.to + window.beyond) continue;
    Places together;
    double weight = 0;
    int sharp = 0;
    for (const EdgeCrossing& other : places) {
      const double allowed = kEnds.agree + 2 * std::hypot(most_slope * (one.away - other.away),
                                                          one.deviation, other.deviation);
      if (std::abs(one.along - other.along) > allowed) continue;
      together.push_back(other);
      weight += weight_of(other);
      sharp += other.sharp;
    }
    const bool expected = one.along >= window.from && one.along <= window.to;
    if ((expected || sharp >= kEnds.sharp_beyond) && weight > best.weight)
      best = {std::move(together), weight};
  }
  return best;
}

// As if the edge were square to the seam.
Places sheared(Places places, double slope) {
  for (EdgeCrossing& place : places) place.along -= slope * place.away;
  return places;
}

// Of the edges through two places over which stripes fall off the plate, the one that most such
// places tell; 0 for none. A shadow's edge, or a tool's outline, has the plate or the tool behind
// it.
double slope_told(const Places& all, const EdgeWindow& window) {
  Places places;
  std::copy_if(all.begin(), all.end(), std::back_inserter(places),
               [](const EdgeCrossing& place) { return place.falls && place.sharp; });
  double best = 0, most = 0;
  for (const EdgeCrossing& a : places)
    for (const EdgeCrossing& b : places) {
      if (b.away - a.away < kEnds.direction_base) continue;
      const double slope = (b.along - a.along) / (b.away - a.away);
      const double foot = a.along - slope * a.away;
      if (std::abs(slope) > kEnds.steepest || foot < window.from - window.beyond ||
          foot > window.to + window.beyond)
        continue;
      double weight = 0;
      int count = 0;
      for (const EdgeCrossing& place : places)
        if (std::abs(place.along - foot - slope * place.away) < kEnds.agree + 2 * place.deviation)
          weight += weight_of(place), ++count;
      if (count >= kEnds.slope_places && weight > most) most = weight, best = slope;
    }
  return best;
}

// Of the places of one edge those that tell where it lies, as if it were cut square, and the slope
// at which it is cut where it is not.
struct EdgePlaces {
  Places places;
  double cut = 0;
};

bool clear(const EdgeCrossing& place) { return place.sharp && !place.occluded; }

EdgePlaces places_on_edge(const Places& places, const EdgeWindow& window,
                          const SeamFindingSettings& settings) {
  Agreement best = largest_agreement(places, window, settings.edge_slope());
  double cut = slope_told(places, window);
  if (cut != 0) {
    Agreement slanted = largest_agreement(sheared(places, cut), window, settings.edge_slope());
    if (slanted.weight > best.weight + kEnds.slanted)
      best = std::move(slanted);
    else
      cut = 0;
  }
  Places& on_edge = best.places;
  // What is seen of the plate before something else tells no more than that it reaches so far.
  if (2 * std::count_if(on_edge.begin(), on_edge.end(), clear) >=
      static_cast<std::ptrdiff_t>(on_edge.size()))
    std::erase_if(on_edge, [](const EdgeCrossing& place) { return place.occluded; });
  // A lone stripe that ends beside the seam, or cannot be seen to, ends for another reason.
  if (on_edge.size() == 1 && (on_edge[0].away <= kVisibility.near_seam || !on_edge[0].sharp))
    on_edge.clear();
  return {std::move(on_edge), cut};
}

std::optional<PlateEdge> edge_through(Places on_edge, double cut,
                                      const SeamFindingSettings& settings) {
  EdgeFit fit = through_the_middle(on_edge);
  const double slope = cut != 0         ? kEnds.steepest
                       : fit.slope == 0 ? settings.edge_slope()
                                        : std::max(kVisibility.end_slope, settings.edge_slope());
  for (int pass = 0; pass < 3; ++pass) {
    const double spread = spread_about(on_edge, fit), known = known_to(on_edge);
    const auto count = static_cast<double>(on_edge.size());
    const double noise =
        std::sqrt((kEnds.prior_places * kEnds.least_place_noise * kEnds.least_place_noise +
                   count * std::max(0.0, spread * spread - known * known)) /
                  (kEnds.prior_places + count - 1));
    std::erase_if(on_edge, [&](const EdgeCrossing& place) {
      return off_edge(place, fit) > kFit.outlier * std::sqrt(variance_of(place, noise));
    });
    if (on_edge.empty()) return std::nullopt;
    fit = fit_edge(on_edge, noise, slope);
  }
  PlateEdge edge;
  edge.along = fit.at_seam;
  edge.slope = cut == 0 ? 0 : cut + fit.slope;
  const auto mean = [&on_edge](double EdgeCrossing::*value) {
    double sum = 0;
    for (const EdgeCrossing& place : on_edge) sum += place.*value;
    return sum / static_cast<double>(on_edge.size());
  };
  edge.away = mean(&EdgeCrossing::away);
  edge.pixel = mean(&EdgeCrossing::pixel);
  edge.variance = fit.variance + kEnds.edge_floor * kEnds.edge_floor +
                  std::pow(kEnds.common_deviation * edge.pixel, 2);
  edge.stripes = static_cast<int>(on_edge.size());
  const auto occluded = std::count_if(on_edge.begin(), on_edge.end(),
                                      [](const EdgeCrossing& p) { return p.occluded; });
  edge.occluded = 2 * occluded > edge.stripes;
  if (std::count_if(on_edge.begin(), on_edge.end(), clear) > 1)
    edge.clear_to = std::max_element(on_edge.begin(), on_edge.end(),
                                     [](const EdgeCrossing& a, const EdgeCrossing& b) {
                                       return a.away < b.away;
                                     })
                        ->away;
  return edge;
}

}  // namespace

std::optional<PlateEdge> find_edge(const ScanCloud& cloud, const PlateStripes& stripes,
                                   SeamSide side, const EdgeWindow& window, const Scales& scales,
                                   const SeamFindingSettings& settings) {
  Places places;
  // What lies farther from the seam is the plate's other edge, along the seam.
  const double far = stripes.reach - kVisibility.far_edge;
  for (const auto& run : stripes.runs)
    if (const auto place = edge_crossing(cloud, run, stripes, side, scales, settings))
      if (place->away < far && (place->sharp || place->away > kVisibility.near_seam))
        places.push_back(*place);
  const auto [on_edge, cut] = places_on_edge(places, window, settings);
  return on_edge.empty() ? std::nullopt : edge_through(on_edge, cut, settings);
}

CommonEnd end_of_both(const PlateEdge& a, const PlateEdge& b, SeamSide side) {
  const double outward = side == SeamSide::kEnd ? 1 : -1;
  const double variance = a.variance + b.variance, deviation = std::sqrt(variance);
  const double apart = outward * (b.along - a.along) / deviation;
  const double chance = std::exp(-apart * apart / 2);
  const double flush = 1 / (1 + deviation / (kEnds.flush_odds * chance));
  const CommonEnd one{(a.along * b.variance + b.along * a.variance) / variance,
                      a.variance * b.variance / variance};
  // The lesser of two normal distributions (Clark 1961), from `a` outward.
  const double a_first = 0.5 * std::erfc(-apart / std::numbers::sqrt2), b_first = 1 - a_first;
  const double way = outward * (b.along - a.along);
  const double spread = deviation * chance / std::sqrt(2 * std::numbers::pi);
  const double mean = way * b_first - spread;
  const double square = a.variance * a_first + (way * way + b.variance) * b_first - way * spread;
  const CommonEnd lesser{a.along + outward * mean, square - mean * mean};

  CommonEnd end{flush * one.along + (1 - flush) * lesser.along, 0};
  end.variance = flush * (one.variance + std::pow(one.along - end.along, 2)) +
                 (1 - flush) * (lesser.variance + std::pow(lesser.along - end.along, 2));
  return end;
}

}  // namespace arcstart::seam_finding
