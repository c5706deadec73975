#include "services/seam_finding/cloud/sampling.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace arcstart::seam_finding;

namespace {

// Stripes every 4 mm, a point every millimetre; the surface rises and falls from stripe to stripe
// by so much, as among slots and things that lie about. mm
ScanCloud uneven_scan(double unevenness, double noise) {
  std::mt19937 engine(3);
  std::normal_distribution<double> off(0, noise);
  std::uniform_real_distribution<double> height(-unevenness, unevenness);
  ScanCloud cloud;
  for (int stripe = 0; stripe < 40; ++stripe) {
    const double x = 4.0 * stripe, level = height(engine);
    for (double y = 0; y < 80; y += 1) {
      cloud.points.emplace_back(x, y, level + off(engine));
      cloud.origins.push_back({stripe, 0, y == 0 || y == 79, 0, 0.1f});
    }
    end_stripe(cloud, ScanStripe::Seen::kSeen, {x, 40, 300}, {x, 0, 300});
  }
  return cloud;
}

}  // namespace

TEST_CASE("on a flat surface the noise is that of its points") {
  for (const double noise : {0.03, 0.1, 0.3})
    CHECK(measure_sampling(uneven_scan(0, noise)).noise == Approx(noise).epsilon(0.15));
}

TEST_CASE("an uneven scene is not taken for a noisy one") {
  CHECK(measure_sampling(uneven_scan(2, 0.05)).noise < 0.2);
}

TEST_CASE("stripes that lie unevenly, for the positions err, are noise up to thrice their own") {
  const double noise = measure_sampling(uneven_scan(0.1, 0.05)).noise;
  CHECK(noise > 0.06);
  CHECK(noise < 0.15);
}
