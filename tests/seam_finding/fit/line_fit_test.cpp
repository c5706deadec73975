#include "services/seam_finding/fit/line_fit.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace arcstart;
using namespace arcstart::seam_finding;

TEST_CASE("a border is the line through its places, outliers aside, with its own deviation") {
  constexpr double kAt = 3, kSlope = 0.2, kNoise = 0.1;
  int within = 0, slopes_within = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> noise(0, kNoise);
    std::vector<LinePlace> places;
    for (int i = 0; i < 25; ++i)
      places.push_back({i * 4.0, kAt + kSlope * i * 4.0 + noise(engine), 0, kNoise});
    places[7].across += 6, places[18].across -= 4;
    const auto fit = fit_line(places, 0.1);
    REQUIRE(fit);
    CHECK(fit->places <= 24);
    within +=
        std::abs(fit->across_at(50) - kAt - kSlope * 50) < 2 * std::sqrt(fit->variance_at(50));
    slopes_within += std::abs(fit->slope - kSlope) < 2 * std::sqrt(fit->slope_variance);
  }
  CHECK(within > 180);
  CHECK(slopes_within > 180);
}

TEST_CASE("places that are off together, as on a tack's flank, do not draw a border aside") {
  constexpr double kAt = 30, kSlope = -0.25, kNoise = 0.1;
  int true_within = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> noise(0, kNoise);
    std::vector<LinePlace> places;
    for (int i = 0; i < 19; ++i)
      places.push_back({i * 1.5 - 20, kAt + kSlope * (i * 1.5 - 20) + noise(engine), 0, kNoise});
    // At the end, where they have a long lever.
    for (int i = 0; i < 7; ++i)
      places.push_back(
          {22 + i * 2.0, kAt + kSlope * (22 + i * 2.0) - 4 + noise(engine), 0, kNoise});
    const auto fit = fit_line(places, 0.1);
    REQUIRE(fit);
    true_within += std::abs(fit->slope - kSlope) < 3 * std::sqrt(fit->slope_variance) &&
                   std::abs(fit->across_at(0) - kAt) < 3 * std::sqrt(fit->variance_at(0));
    CHECK(std::sqrt(fit->slope_variance) < 0.01);
  }
  CHECK(true_within >= 196);
}

TEST_CASE("of two lines with six and four in ten of the places neither is taken for the border") {
  std::vector<LinePlace> places;
  for (int i = 0; i < 20; ++i) places.push_back({i * 4.0, i % 5 < 3 ? 0.0 : 2.0, 0, 0.1});
  const auto fit = fit_line(places, 0.1);
  REQUIRE(fit);
  CHECK(fit->places == 20);
  CHECK(fit->at_middle == Approx(0.8).margin(0.2));
  CHECK(std::sqrt(fit->variance) > 0.2);
}

TEST_CASE("points on a cut give the border at the height wanted") {
  std::vector<LinePlace> places;
  for (int i = 0; i < 20; ++i)
    for (const double height : {-1.0, -3.0, -5.0})
      places.push_back({i * 4.0, 2 + 0.577 * height, height, 0.1});
  const auto free = fit_line(places, 3);
  REQUIRE(free);
  CHECK(free->lean == Approx(0.577).margin(0.01));
  CHECK(free->across_at(40) == Approx(2).margin(0.02));
}

TEST_CASE("too few places, or all at one place along, give none") {
  CHECK_FALSE(fit_line({}, 1));
  CHECK_FALSE(fit_line({{0, 0}, {1, 0}, {2, 0}}, 1));
  CHECK_FALSE(fit_line(std::vector<LinePlace>(10, {5, 1}), 1));
}
