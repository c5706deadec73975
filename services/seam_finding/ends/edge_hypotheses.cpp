#include "services/seam_finding/ends/edge_hypotheses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "services/seam_finding/ends/constants.hpp"

namespace arcstart::seam_finding {

double leaving(const EdgeCrossing& edge, double slope) {
  return edge.way_along - slope * edge.way_away;
}

double variance_of(const EdgeCrossing& edge, double slope, double roughness) {
  const auto square = [](double x) { return x * x; };
  const double leaves = leaving(edge, slope);
  const double light =
      kEnds.light_deviation + kEnds.flat_deviation * std::max(0.0, kEnds.flat_crossing - leaves);
  return square(edge.deviation) + square(leaves * edge.spread) +
         square(edge.ended ? light * edge.pixel : 0) + square(roughness) +
         square(kEnds.least_place_noise);
}

namespace {

// Of a normal distribution three slopes stand for all (Gauss and Hermite), of a rough edge the mean
// alone: it does not tell them apart.
void add_normal(double mean, double deviation, double weight, std::vector<Slope>& slopes) {
  const double beside = std::numbers::sqrt3 * deviation;
  Slope low{mean - beside, {}}, middle{mean, {}}, high{mean + beside, {}};
  for (const auto& [roughness, share] : kEnds.roughness) {
    const bool rough = roughness == kEnds.roughness.back().first;
    middle.hypotheses.push_back({roughness, weight * share * (rough ? 1 : 2.0 / 3)});
    if (rough) continue;
    low.hypotheses.push_back({roughness, weight * share / 6});
    high.hypotheses.push_back({roughness, weight * share / 6});
  }
  for (Slope* slope : {&low, &middle, &high}) slopes.push_back(std::move(*slope));
}

// About a slope that crossings tell, of all slopes alike: close to each other where smooth edges
// lie, farther apart where rough ones may. deviation: of a smooth edge's slope; density: per slope.
void add_told(double slope, double deviation, double density, std::vector<Slope>& slopes) {
  // In deviations; and how much of the slopes each stands for (trapezoidal rule).
  constexpr std::array<double, 9> kPlaces = {-8, -4, -2, -1, 0, 1, 2, 4, 8};
  constexpr std::array<double, 9> kReaches = {4, 3, 1.5, 1, 1, 1, 1.5, 3, 4};
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    Slope near{slope + kPlaces[i] * deviation, {}};
    for (const auto& [roughness, share] : kEnds.roughness)
      near.hypotheses.push_back({roughness, density * kReaches[i] * deviation * share});
    slopes.push_back(std::move(near));
  }
}

// The slope that edges through pairs of crossings tell, and how well.
struct Told {
  double slope = 0, deviation = 0;
  double weight = 0;  // of the crossings that tell it; 1/mm2
};

std::vector<Told> slopes_told(const std::vector<StripeEvidence>& evidence, const PlaceGrid& grid) {
  std::vector<const EdgeCrossing*> edges;
  for (const StripeEvidence& stripe : evidence)
    for (const EdgeCrossing& edge : stripe.edges)
      if (!edge.occluded) edges.push_back(&edge);
  std::vector<Told> told;
  // An edge is crossed by stripes that follow each other; between them one may end elsewhere.
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size() && j <= i + kModel.stripes_in_a_row; ++j) {
      const EdgeCrossing *a = edges[i], *b = edges[j];
      const double apart = b->away - a->away;
      if (std::abs(apart) < kEnds.direction_base) continue;
      const double slope = (b->along - a->along) / apart, foot = a->along - slope * a->away;
      if (std::abs(slope) > kModel.steepest_edge || foot < grid.first ||
          foot > grid.at(grid.count - 1) || leaving(*a, slope) < kEnds.least_slant ||
          leaving(*b, slope) < kEnds.least_slant)
        continue;
      double w = 0, r = 0, t = 0, rr = 0, rt = 0;
      for (const EdgeCrossing* edge : edges) {
        if (leaving(*edge, slope) < kEnds.least_slant) continue;
        if (std::abs(edge->along - foot - slope * edge->away) >
            kFit.outlier * std::sqrt(variance_of(*edge, slope, kEnds.roughness[1].first)))
          continue;
        const double weight = 1 / variance_of(*edge, slope, kEnds.grid_step);
        w += weight, r += weight * edge->away, t += weight * edge->along;
        rr += weight * edge->away * edge->away, rt += weight * edge->away * edge->along;
      }
      const double spread = rr - r * r / w;
      const double fitted = (rt - r * t / w) / spread;
      told.push_back({fitted, 1 / std::sqrt(spread), w});
    }
  std::sort(told.begin(), told.end(),
            [](const Told& a, const Told& b) { return a.weight > b.weight; });
  std::vector<Told> kept;
  for (const Told& one : told) {
    if (kept.size() >= kEnds.most_told) break;
    if (std::none_of(kept.begin(), kept.end(), [&](const Told& other) {
          return std::abs(other.slope - one.slope) < 3 * std::hypot(other.deviation, one.deviation);
        }))
      kept.push_back(one);
  }
  return kept;
}

}  // namespace

std::vector<Slope> slopes_of(const std::vector<StripeEvidence>& evidence, const PlaceGrid& grid,
                             const SquareEdge& square) {
  std::vector<Slope> slopes;
  add_normal(square.slope, square.deviation, 1 - kEnds.slanted_share, slopes);
  const double density = kEnds.slanted_share / (2 * kModel.steepest_edge);
  for (const Told& told : slopes_told(evidence, grid)) {
    if (std::abs(told.slope - square.slope) < 3 * std::hypot(square.deviation, told.deviation))
      continue;
    add_told(told.slope, told.deviation, density, slopes);
  }
  for (int i = 0; i < kEnds.slanted_steps; ++i)
    slopes.push_back({kModel.steepest_edge * ((2.0 * i + 1) / kEnds.slanted_steps - 1),
                      {{kEnds.roughness.back().first, kEnds.slanted_share / kEnds.slanted_steps}}});
  return slopes;
}

}  // namespace arcstart::seam_finding
