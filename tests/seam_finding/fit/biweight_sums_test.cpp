// Sums with Tukey's weights against the formula in doubles, point by point.
#include "services/seam_finding/fit/biweight_sums.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

using namespace arcstart;
using namespace arcstart::seam_finding;

TEST_CASE("weighted sums are those of the formula, for any number of points") {
  const double offset = 0.05, along = 1e-3, across = -2e-3, limit = 0.4;
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> place(-60, 60);
  std::normal_distribution<float> noise(0, 0.2f);
  for (const std::size_t count : {1, 15, 16, 17, 1000, 5000}) {
    std::vector<float> a(whole_registers(count)), b(a.size()), h(a.size(), 1e9f);
    REQUIRE(a.size() % 16 == 0);
    REQUIRE(a.size() < count + 16);
    BiweightSums judge;
    for (std::size_t i = 0; i < count; ++i) {
      a[i] = place(engine), b[i] = place(engine), h[i] = noise(engine);
      const double r = h[i] - offset - along * a[i] - across * b[i];
      if (std::abs(r) >= limit) continue;
      const double w = std::pow(1 - r * r / (limit * limit), 2);
      judge.w += w, judge.a += w * a[i], judge.b += w * b[i], judge.r += w * r;
      judge.aa += w * a[i] * a[i], judge.ab += w * a[i] * b[i], judge.bb += w * b[i] * b[i];
      judge.ra += w * r * a[i], judge.rb += w * r * b[i];
    }
    const BiweightSums sums =
        biweight_sums({a.data(), b.data(), h.data(), a.size()}, offset, along, across, limit);
    // Of terms that may cancel: relative to how large they are.
    const auto n = static_cast<double>(count);
    CHECK(sums.w == Approx(judge.w).margin(1e-5 * n));
    CHECK(sums.a == Approx(judge.a).margin(1e-5 * 60 * n));
    CHECK(sums.b == Approx(judge.b).margin(1e-5 * 60 * n));
    CHECK(sums.aa == Approx(judge.aa).margin(1e-5 * 3600 * n));
    CHECK(sums.ab == Approx(judge.ab).margin(1e-5 * 3600 * n));
    CHECK(sums.bb == Approx(judge.bb).margin(1e-5 * 3600 * n));
    CHECK(sums.r == Approx(judge.r).margin(1e-5 * 0.2 * n));
    CHECK(sums.ra == Approx(judge.ra).margin(1e-5 * 12 * n));
    CHECK(sums.rb == Approx(judge.rb).margin(1e-5 * 12 * n));
  }
}
