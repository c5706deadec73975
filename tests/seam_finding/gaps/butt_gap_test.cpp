// Narrow gaps against sights into them in closed form, smoothed by convolution.
#include "services/seam_finding/gaps/butt_gap.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/seam_finding/support/synthetic_random.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

struct ButtDrawing {
  double from = -0.3, width = 1;  // of the gap across, at along = 0; mm
  double slope = 0.03;
  double sight = 0.78;                  // mm across for each mm down
  double rounding = 0.3, noise = 0.03;  // mm
};

// Where the line of sight across `x` ends: on the plates' top, or past the nearer edge on the
// farther plate's cut.
double depth_seen(double x, const ButtDrawing& drawing) {
  if (x <= drawing.from || x >= drawing.from + drawing.width) return 0;
  const double to_cut = drawing.sight > 0 ? drawing.from + drawing.width - x : x - drawing.from;
  return -to_cut / std::abs(drawing.sight);
}

std::vector<SeenPlace> draw_butt(const ButtDrawing& drawing) {
  synthetic::Random random{std::mt19937_64(3)};
  std::vector<SeenPlace> places;
  for (double along = -45; along < 45; along += 3.6)
    for (int i = 0; i < 8; ++i) {
      const double x = random.between(-3, 3);
      double sum = 0, weights = 0;
      for (double off = -4 * drawing.rounding; off <= 4 * drawing.rounding;
           off += drawing.rounding / 20) {
        const double z = off / drawing.rounding, weight = std::exp(-z * z / 2);
        sum += weight * depth_seen(x + off, drawing), weights += weight;
      }
      places.push_back(
          {along, x + drawing.slope * along, sum / weights + random.normal(drawing.noise)});
    }
  return places;
}

ButtGapSearch search_for(const ButtDrawing& drawing) {
  ButtGapSearch search;
  search.across = 0.4, search.slope = drawing.slope - 0.01;  // told badly
  search.sight = drawing.sight;
  search.noise = drawing.noise;
  return search;
}

}  // namespace

TEST_CASE("a narrow gap's borders are where its rounded sawtooth says, from either side") {
  for (const double sight : {0.78, -0.78, 0.5})
    for (const double width : {0.6, 1.0, 2.0})
      for (const double rounding : {0.05, 0.3}) {
        ButtDrawing drawing;
        drawing.sight = sight, drawing.width = width, drawing.rounding = rounding;
        INFO("sight " << sight << ", width " << width << ", rounding " << rounding);
        const auto borders = fit_butt_gap(draw_butt(drawing), search_for(drawing));
        REQUIRE(borders);
        const auto& [low, high] = *borders;
        CHECK(low.across_at(0) == Approx(drawing.from).margin(0.06));
        CHECK(high.across_at(0) == Approx(drawing.from + width).margin(0.06));
        CHECK(low.slope == Approx(drawing.slope).margin(0.001));
        CHECK(low.slope == high.slope);
        CHECK(low.variance > 0);
        CHECK(std::sqrt(low.variance) < 0.1);
      }
}

TEST_CASE("plates without a gap, and gaps that are none, give nothing") {
  ButtDrawing drawing;
  drawing.width = 0;
  CHECK_FALSE(fit_butt_gap(draw_butt(drawing), search_for(drawing)));
  CHECK_FALSE(fit_butt_gap({}, search_for(drawing)));

  // Strays below the plates, here and there.
  auto places = draw_butt(drawing);
  synthetic::Random random{std::mt19937_64(5)};
  for (std::size_t i = 0; i < places.size(); i += 9) places[i].height = random.between(-3, -0.3);
  CHECK_FALSE(fit_butt_gap(places, search_for(drawing)));

  drawing.width = 2;
  ButtGapSearch search = search_for(drawing);
  search.widest = 1.5;
  CHECK_FALSE(fit_butt_gap(draw_butt(drawing), search));
}

TEST_CASE("strays do not move a narrow gap's borders") {
  ButtDrawing drawing;
  auto places = draw_butt(drawing);
  for (std::size_t i = 0; i < places.size(); i += 20) places[i].height += i % 40 == 0 ? 8 : -8;
  const auto borders = fit_butt_gap(places, search_for(drawing));
  REQUIRE(borders);
  CHECK((*borders)[0].across_at(0) == Approx(drawing.from).margin(0.1));
  CHECK((*borders)[1].across_at(0) == Approx(drawing.from + drawing.width).margin(0.1));
}
