#include "services/seam_finding/ends/foot_likelihood.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/seam_finding/support/likelihood_moments.hpp"

using namespace arcstart::seam_finding;

namespace {

constexpr PlaceGrid kGrid{-30, 0.05, 1800};
constexpr SquareEdge kSquare{0, 0.001};  // mm along for each mm away: as good as square
constexpr double kSpacing = 3.6;         // mm, between stripes
constexpr double kSlant = 0.3;           // mm along for each mm away, of the stripes
constexpr double kWide = 45;             // mm, of the plate
constexpr double kDeviation = 0.05;      // mm, of a crossing

// Stripes of a plate that ends at a straight edge, outward along x: each is seen on it from the
// seam to the edge or the plate's far side, crosses the edge, and falls behind it. The truth of a
// stripe's crossing is where two lines meet.
std::vector<StripeEvidence> stripes_of(double foot, double slope, std::mt19937* noise = nullptr) {
  std::normal_distribution<double> off(0, kDeviation);
  std::vector<StripeEvidence> stripes;
  for (double x = foot - 60 + 0.37 * kSpacing; x < foot + 40; x += kSpacing) {
    StripeEvidence stripe;
    const double away = (foot - x) / (kSlant - slope);  // of the crossing
    const bool at_seam = x<foot, steeper = slope> kSlant;
    const bool crosses = away > 3 && away < kWide - 3;
    // Over an edge steeper than itself it comes onto the plate.
    const double begin = steeper && crosses ? away + 0.7 : 0;
    const double end = !steeper && crosses ? away - 0.7 : kWide;  // its light ends before the edge
    const auto at = [&](double r) { return PlacePart{x + kSlant * r, r}; };
    if (!at_seam) stripe.absent = PlacePart{x, 0};
    if (at_seam || (steeper && crosses)) stripe.on.push_back({at(begin), at(end)});
    if (crosses) {
      EdgeCrossing edge;
      edge.along = x + kSlant * away + (noise ? off(*noise) : 0), edge.away = away;
      const double out = (steeper ? -1 : 1) / std::hypot(1, kSlant);
      edge.way_along = kSlant * out, edge.way_away = out;
      edge.deviation = kDeviation, edge.pixel = 0.3, edge.falls = true;
      stripe.edges.push_back(edge);
    }
    if (!at_seam && !stripe.edges.empty() && steeper)
      stripe.off.push_back({at(3), at(away - 1)});
    else if (!at_seam)
      stripe.off.push_back({PlacePart{x + 1, 4}, PlacePart{x + 1 + kSlant * 36, 40}});
    stripes.push_back(stripe);
  }
  return stripes;
}

void without_crossings(std::vector<StripeEvidence>& stripes) {
  for (StripeEvidence& stripe : stripes) {
    if (!stripe.edges.empty()) stripe.on.clear();
    stripe.edges.clear();
  }
}

}  // namespace

TEST_CASE("a square edge is as sure as the mean of its crossings") {
  int within = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 noise(seed);
    const double foot = 0.09 * seed;
    const auto stripes = stripes_of(foot, 0, &noise);
    int crossings = 0;
    for (const StripeEvidence& stripe : stripes) crossings += static_cast<int>(stripe.edges.size());
    REQUIRE(crossings >= 3);
    const auto likelihood = foot_likelihood(stripes, kGrid, kSquare);
    const PlaceMoments found = moments_of(likelihood, kGrid);
    INFO("seed " << seed << ", " << found.mean << " for " << foot << ", deviation "
                 << found.deviation);
    CHECK_FALSE(likelihood.occluded);
    CHECK(found.deviation >= 0.9 * kDeviation / std::sqrt(crossings));
    CHECK(found.deviation < 3 * kDeviation);
    within += std::abs(found.mean - foot) <= 2 * found.deviation;
  }
  CHECK(within >= 36);  // 0.95 of 40, less two deviations
}

TEST_CASE("the slope of an edge is told by what crosses it") {
  for (const double slope : {-0.45, -0.2, 0.1, 0.15, 0.45, 0.55}) {
    int within = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      std::mt19937 noise(seed);
      const double foot = 0.17 * seed;
      const auto found =
          moments_of(foot_likelihood(stripes_of(foot, slope, &noise), kGrid, kSquare), kGrid);
      INFO("slope " << slope << ", seed " << seed);
      CHECK(std::abs(found.mean - foot) < 0.4);
      within += std::abs(found.mean - foot) <= 2 * found.deviation;
    }
    CHECK(within >= 17);
  }
}

TEST_CASE(
    "where no stripe crosses an edge it lies between the last on the plate and the first past") {
  auto stripes = stripes_of(0, 0);
  without_crossings(stripes);
  double on = -1e9, past = 1e9;
  for (const StripeEvidence& stripe : stripes) {
    if (!stripe.on.empty()) on = std::max(on, stripe.on[0][0].out);
    if (stripe.absent) past = std::min(past, stripe.absent->out);
  }
  // Their stripes reach far out: the plate is there, square or not, up to their far ends.
  const auto likelihood = foot_likelihood(stripes, kGrid, kSquare);
  CHECK(share_between(likelihood, kGrid, on - 0.1, past + 0.1) > 0.7);
  CHECK(share_between(likelihood, kGrid, past + kSpacing, 60) < 0.02);
}

TEST_CASE("the outline of something before a plate is no edge of it") {
  auto stripes = stripes_of(0, 0);
  for (StripeEvidence& stripe : stripes) {
    stripe.off.clear();
    stripe.covered = stripe.absent.has_value();
    for (EdgeCrossing& edge : stripe.edges) edge.occluded = true, edge.falls = false;
  }
  const auto likelihood = foot_likelihood(stripes, kGrid, kSquare);
  CHECK(share_between(likelihood, kGrid, -30, -1) < 0.01);  // it is seen on the plate
  CHECK(share_between(likelihood, kGrid, 5, 60) > 0.5);     // and may go on behind
}

TEST_CASE("a thing as high as a plate, behind a place that is seen past, does not prolong it") {
  auto stripes = stripes_of(0, 0);
  for (StripeEvidence& stripe : stripes)
    if (stripe.absent && stripe.absent->out > 15)
      stripe.on.push_back(
          {PlacePart{stripe.absent->out, 5}, PlacePart{stripe.absent->out + 40 * kSlant, 45}});
  const auto found = moments_of(foot_likelihood(stripes, kGrid, kSquare), kGrid);
  CHECK(std::abs(found.mean) < 0.1);
}

TEST_CASE("a plate goes on behind a hole that stripes are seen through") {
  auto stripes = stripes_of(0, 0);
  for (StripeEvidence& stripe : stripes)
    if (!stripe.on.empty() && stripe.on[0][0].out > -25 && stripe.on[0][0].out < -15)
      stripe.off.push_back({PlacePart{stripe.on[0][0].out + 20 * kSlant, 20},
                            PlacePart{stripe.on[0][0].out + 30 * kSlant, 30}});
  const auto found = moments_of(foot_likelihood(stripes, kGrid, kSquare), kGrid);
  CHECK(std::abs(found.mean) < 0.1);
}

TEST_CASE("a plate whose corner is cut out ends there at the seam") {
  constexpr double kCope = 12;  // mm, quarter round
  auto stripes = stripes_of(0, 0);
  for (StripeEvidence& stripe : stripes) {
    if (stripe.absent) continue;
    const double x = stripe.on[0][0].out;
    if (x < -kCope) continue;
    // Where the stripe comes out of the hole.
    double away = 0;
    while (std::hypot(x + kSlant * away, away) < kCope) away += 0.01;
    stripe.absent = PlacePart{x, 0};
    stripe.on[0][0] = {x + kSlant * away, away};
    stripe.off.push_back({PlacePart{x + kSlant * 3.5, 3.5}, PlacePart{x + kSlant * away, away}});
  }
  const auto likelihood = foot_likelihood(stripes, kGrid, kSquare);
  CHECK(share_between(likelihood, kGrid, -kCope - kSpacing, -kCope + kSpacing) > 0.8);
}

TEST_CASE("nothing seen tells nothing") {
  const auto likelihood = foot_likelihood({}, kGrid, kSquare);
  CHECK(share_between(likelihood, kGrid, -30, 15) == Approx(0.5).margin(0.01));
}

TEST_CASE("an edge square to a seam that is bent there is as sure as any square one") {
  const double bent = 0.03;  // mm along for each mm away
  std::mt19937 noise(5);
  const auto stripes = stripes_of(1, bent, &noise);
  const auto found = moments_of(foot_likelihood(stripes, kGrid, {bent, 0.001}), kGrid);
  CHECK(found.mean == Approx(1).margin(3 * found.deviation));
  CHECK(found.deviation < 2 * kDeviation);
  // Taken for square to the line, its crossings do not lie on one edge.
  CHECK(moments_of(foot_likelihood(stripes, kGrid, kSquare), kGrid).deviation > found.deviation);
}
