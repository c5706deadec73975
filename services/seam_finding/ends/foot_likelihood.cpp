#include "services/seam_finding/ends/foot_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "services/seam_finding/ends/constants.hpp"
#include "services/seam_finding/ends/edge_model.hpp"

namespace arcstart::seam_finding {
namespace {

FootLikelihood of_straight_edge(const std::vector<StripeEvidence>& evidence, const PlaceGrid& grid,
                                const SquareEdge& square) {
  const EdgeModel model(evidence, grid);
  FootLikelihood likelihood;
  likelihood.at.assign(static_cast<std::size_t>(grid.count), 0);
  double& scale = likelihood.scale;
  scale = -std::numeric_limits<double>::infinity();
  std::vector<double> log;
  int best_place = 0;
  double best_slope = 0, best_roughness = 0;
  for (const Slope& slope : slopes_of(evidence, grid, square)) {
    const std::vector<double> steps = model.steps(slope.slope);
    for (const auto& [roughness, weight] : slope.hypotheses) {
      log = steps;
      model.add_peaks(slope.slope, roughness, log);
      const double prior = std::log(weight);
      const auto top = std::max_element(log.begin(), log.end());
      if (*top + prior > scale) {
        if (std::isfinite(scale))
          for (double& value : likelihood.at) value *= std::exp(scale - *top - prior);
        scale = *top + prior;
        best_place = static_cast<int>(top - log.begin());
        best_slope = slope.slope, best_roughness = roughness;
      }
      for (std::size_t i = 0; i < log.size(); ++i)
        if (const double value = log[i] + prior - scale; value > kEnds.least_log)
          likelihood.at[i] += std::exp(value);
    }
  }
  const EdgeTold told = model.told_at(grid.at(best_place), best_slope, best_roughness);
  likelihood.slope = best_slope;
  likelihood.occluded =
      told.occluded >= kEnds.outline_stripes && 2 * told.occluded > told.crossings;
  likelihood.deviation = told.common;
  return likelihood;
}

// A part of a stretch, so far away from the seam; nothing where it has none.
std::optional<Stretch> clipped(const Stretch& stretch, double from, double to) {
  const bool rises = stretch[0].away <= stretch[1].away;
  const PlacePart &low = stretch[rises ? 0 : 1], &high = stretch[rises ? 1 : 0];
  if (high.away < from || low.away > to) return std::nullopt;
  const auto at = [&](double away) {
    const double reach = high.away - low.away;
    const double share = reach > 0 ? (away - low.away) / reach : 0;
    return PlacePart{low.out + share * (high.out - low.out), away};
  };
  return Stretch{at(std::max(from, low.away)), at(std::min(to, high.away))};
}

std::vector<StripeEvidence> between(const std::vector<StripeEvidence>& evidence, double from,
                                    double to) {
  std::vector<StripeEvidence> parts;
  for (const StripeEvidence& stripe : evidence) {
    StripeEvidence part;
    part.covered = stripe.covered;
    for (const Stretch& on : stripe.on)
      if (const auto piece = clipped(on, from, to)) part.on.push_back(*piece);
    for (const Stretch& off : stripe.off)
      if (const auto piece = clipped(off, from, to)) part.off.push_back(*piece);
    for (const EdgeCrossing& edge : stripe.edges)
      if (edge.away >= from && edge.away <= to) part.edges.push_back(edge);
    if (from <= 0) part.absent = stripe.absent;
    parts.push_back(std::move(part));
  }
  return parts;
}

// Where the straight edge far from the seam lies farther out by no more than a cope hole is wide.
// What lies between tells nothing of either.
void add_coped(const std::vector<StripeEvidence>& evidence, const std::vector<double>& near,
               const PlaceGrid& grid, const SquareEdge& square, FootLikelihood& likelihood) {
  const auto far = of_straight_edge(
      between(evidence, kEnds.cope_most, std::numeric_limits<double>::infinity()), grid, square);
  const auto reach = static_cast<std::size_t>(kEnds.cope_most / grid.step);
  double prior = std::log(kEnds.coped_share / kEnds.cope_most * grid.step) + far.scale;
  for (const StripeEvidence& stripe : evidence)
    for (const EdgeCrossing& edge : stripe.edges)
      if (!edge.occluded && edge.away < kEnds.cope_most) prior -= std::log(kEnds.way_seen);
  std::vector<double> coped(near.size());
  double sum = 0, scale = likelihood.scale;
  for (std::size_t i = near.size(); i-- > 0;) {
    sum += far.at[i];
    if (i + reach < near.size()) sum -= far.at[i + reach];
    coped[i] = sum > 0 ? prior + near[i] + std::log(sum) : -std::numeric_limits<double>::infinity();
    scale = std::max(scale, coped[i]);
  }
  for (std::size_t i = 0; i < near.size(); ++i)
    likelihood.at[i] =
        likelihood.at[i] * std::exp(likelihood.scale - scale) + std::exp(coped[i] - scale);
  likelihood.scale = scale;
}

}  // namespace

FootLikelihood foot_likelihood(const std::vector<StripeEvidence>& evidence, const PlaceGrid& grid,
                               const SquareEdge& square) {
  FootLikelihood likelihood = of_straight_edge(evidence, grid, square);
  const auto beside = between(evidence, 0, kEnds.cope_seen);
  const std::vector<double> near = EdgeModel(beside, grid).steps(0);
  const auto likeliest = std::max_element(likelihood.at.begin(), likelihood.at.end());
  const double claimed = near[static_cast<std::size_t>(likeliest - likelihood.at.begin())];
  if (claimed < *std::max_element(near.begin(), near.end()) - kEnds.cope_told)
    add_coped(evidence, near, grid, square, likelihood);
  return likelihood;
}

}  // namespace arcstart::seam_finding
