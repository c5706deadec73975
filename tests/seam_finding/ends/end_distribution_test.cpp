#include "services/seam_finding/ends/end_distribution.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "services/seam_finding/ends/constants.hpp"

using namespace arcstart::seam_finding;

namespace {

constexpr PlaceGrid kGrid{-5, 0.02, 500};

double normal(double x, double mean, double deviation) {
  return std::exp(-std::pow((x - mean) / deviation, 2) / 2) / (deviation * std::sqrt(2 * EIGEN_PI));
}

template <class Density>
FootLikelihood likelihood_of(Density&& density) {
  FootLikelihood likelihood;
  for (int i = 0; i < kGrid.count; ++i) likelihood.at.push_back(density(kGrid.at(i)));
  return likelihood;
}

FootLikelihood edge_at(double mean, double deviation) {
  return likelihood_of([=](double x) { return normal(x, mean, deviation); });
}

}  // namespace

TEST_CASE("a seam ends where the first of its plates does, or both flush ones") {
  // Over all places that the two edges may have.
  const auto expected = [](double a, double b, double deviation_a, double deviation_b) {
    constexpr double kStep = 0.01;
    double weight = 0, sum = 0, squares = 0;
    for (double x = -1.5; x < 1.5; x += kStep) {
      const double flush =
          kEnds.flush_share * normal(x, a, deviation_a) * normal(x, b, deviation_b) * kStep;
      weight += flush, sum += flush * x, squares += flush * x * x;
      for (double y = -1.5; y < 1.5; y += kStep) {
        const double apart = (1 - kEnds.flush_share) / (2 * kEnds.offsets) *
                             normal(x, a, deviation_a) * normal(y, b, deviation_b) * kStep * kStep;
        const double first = std::min(x, y);
        weight += apart, sum += apart * first, squares += apart * first * first;
      }
    }
    return EndMode{sum / weight, squares / weight - sum * sum / weight / weight, 1};
  };
  for (const double difference : {0.0, 0.1, -0.15, 0.2, -0.25})
    for (const double deviation : {0.06, 0.12}) {
      const double a = 0.1, b = 0.1 + difference;
      const auto modes = seam_end_modes({edge_at(a, deviation), edge_at(b, 0.08)}, kGrid);
      const EndMode truth = expected(a, b, deviation, 0.08);
      CAPTURE(difference, deviation);
      REQUIRE(modes.size() == 1);
      CHECK(modes[0].out == Approx(truth.out).margin(0.003));
      CHECK(std::sqrt(modes[0].variance) == Approx(std::sqrt(truth.variance)).margin(0.003));
      CHECK(modes[0].weight == Approx(1).margin(0.001));
    }
}

TEST_CASE("what all crossings of an edge have in common widens it") {
  FootLikelihood edge = edge_at(0, 0.06);
  edge.deviation = 0.08;
  const FootLikelihood far = edge_at(4, 0.05);
  const auto modes = seam_end_modes({edge, far}, kGrid);
  REQUIRE_FALSE(modes.empty());
  CHECK(std::sqrt(modes[0].variance) == Approx(0.1).margin(0.005));
}

TEST_CASE("two places that both may be the end are both told") {
  const FootLikelihood either =
      likelihood_of([](double x) { return 0.7 * normal(x, -1, 0.05) + 0.3 * normal(x, 1, 0.05); });
  const auto modes = seam_end_modes({either, edge_at(4, 0.05)}, kGrid);
  REQUIRE(modes.size() >= 2);
  CHECK(modes[0].out == Approx(-1).margin(0.01));
  CHECK(modes[0].weight == Approx(0.7).margin(0.01));
  CHECK(modes[1].out == Approx(1).margin(0.01));
  CHECK(modes[1].weight == Approx(0.3).margin(0.01));
}

TEST_CASE("a plate that runs on leaves the end to the other") {
  const FootLikelihood runs_on = likelihood_of([](double x) { return x > -2 ? 1.0 : 0.0; });
  const auto modes = seam_end_modes({runs_on, edge_at(0.5, 0.06)}, kGrid);
  REQUIRE_FALSE(modes.empty());
  CHECK(modes[0].weight > 0.9);
  CHECK(modes[0].out == Approx(0.5).margin(0.15));
}

TEST_CASE("what lies beyond the grid is missing of the weights") {
  const FootLikelihood runs_on = likelihood_of([](double) { return 1.0; });
  const auto modes = seam_end_modes({runs_on, runs_on}, kGrid);
  double weights = 0;
  for (const EndMode& mode : modes) weights += mode.weight;
  CHECK(weights < 0.6);
}
