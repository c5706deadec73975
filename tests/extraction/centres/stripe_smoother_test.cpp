#include "services/extraction/centres/stripe_smoother.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

constexpr double kSigma = 4;

// The crest of a stripe along y(x) after a Gaussian of sigma, to second order for small slopes: the
// mean of y over a Gaussian of that sigma.
template <class Curve>
std::vector<SmoothedPoint> crest(Curve y, int count, double noise, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> grain(0, 1);
  std::vector<SmoothedPoint> points;
  for (int x = 0; x < count; ++x) {
    double mean = 0, weights = 0;
    for (double d = -5 * kSigma; d <= 5 * kSigma; d += 0.25) {
      const double weight = std::exp(-d * d / (2 * kSigma * kSigma));
      mean += weight * y(x + d);
      weights += weight;
    }
    points.push_back({x + 0.0, mean / weights + noise * grain(random), noise, kSigma, false});
  }
  return points;
}

double rms_from(const std::vector<SmoothedPoint>& points, auto y, int first, int last) {
  double sum = 0;
  for (int i = first; i < last; ++i) sum += std::pow(points[i].across - y(points[i].along), 2);
  return std::sqrt(sum / (last - first));
}

}  // namespace

TEST_CASE("a straight course comes out straight, less noisy, and its deviation says how much") {
  const auto line = [](double x) { return 20 + 0.3 * x; };
  double squares = 0, told = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    auto points = crest(line, 300, 0.3, seed);
    // Errors that hang together as the kernels make them, of deviation 0.3.
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0, 1);
    std::vector<double> white(400);
    for (double& w : white) w = normal(random);
    for (int x = 0; x < 300; ++x) {
      double sum = 0, power = 0;
      for (int d = -20; d <= 20; ++d) {
        const double weight = std::exp(-d * d / (2 * kSigma * kSigma));
        sum += weight * white[x + 50 + d];
        power += weight * weight;
      }
      points[x].across = line(x) + 0.3 * sum / std::sqrt(power);
    }
    StripeSmoother().smooth(points);
    for (int i = 40; i < 260; ++i) {
      squares += std::pow(points[i].across - line(points[i].along), 2);
      told += points[i].deviation * points[i].deviation;
    }
  }
  CHECK(std::sqrt(squares / (20 * 220)) < 0.2);
  CHECK(std::sqrt(squares / told) > 0.7);
  CHECK(std::sqrt(squares / told) < 1.4);
}

TEST_CASE("what the kernels cut off a rounded corner is put back") {
  const double slope = GENERATE(0.3, 1.0, -0.7), rounding = 4;
  const auto corner = [&](double x) {  // |x| blurred with a Gaussian
    const double t = (x - 150) / rounding;
    return 50 + slope * rounding *
                    (t * std::erf(t / std::sqrt(2.0)) +
                     std::sqrt(2 / std::numbers::pi) * std::exp(-t * t / 2));
  };
  const auto found = crest(corner, 300, 0.01);
  auto points = found;
  StripeSmoother().smooth(points);
  // A graph's crest moves by the curvature's 1 / (1 + slope^2): exact only at the apex and for
  // small slopes, so that steep flanks keep part of it.
  CHECK(rms_from(points, corner, 140, 160) < 0.35 * rms_from(found, corner, 140, 160));
  CHECK(rms_from(points, corner, 20, 110) < 0.01);
}

TEST_CASE("how far a line is smoothed follows from what its centres are worth") {
  // A bend that comes and goes over 40 px.
  const auto wave = [](double x) { return 30 + 0.6 * std::sin(x / 6); };
  const auto flattened = [&](double deviation) {
    auto points = crest(wave, 300, 0.001);
    for (SmoothedPoint& point : points) point.deviation = deviation;
    StripeSmoother().smooth(points);
    return rms_from(points, wave, 40, 260);
  };
  CHECK(flattened(0.005) < 0.02);
  CHECK(flattened(2) > 0.3);
  // The fainter half of a line tells less than the other.
  auto points = crest([](double) { return 30.0; }, 300, 0.05);
  for (int i = 150; i < 300; ++i) points[i].deviation *= 4;
  StripeSmoother().smooth(points);
  CHECK(points[220].deviation > 1.5 * points[80].deviation);
}

TEST_CASE("a corner is kept in noise that hides a bend") {
  const auto corner = [](double x) { return 50 + 0.8 * std::abs(x - 150); };
  double squares = 0;
  for (int seed = 1; seed <= 10; ++seed) {
    auto points = crest(corner, 300, 0.3, seed);
    StripeSmoother().smooth(points);
    squares += std::pow(rms_from(points, corner, 156, 180), 2) / 10;
  }
  CHECK(std::sqrt(squares) < 0.2);
}

TEST_CASE("points at the border are replaced by what the others say, or given up") {
  const auto line = [](double x) { return 10 + 0.5 * x; };
  auto points = crest(line, 100, 0.02);
  for (int i = 0; i < 8; ++i) {
    points[i].at_border = true;
    points[i].across += 2;  // bent by the mirrored image
  }
  StripeSmoother().smooth(points);
  for (int i = 0; i < 8; ++i) {
    CHECK(points[i].across == Approx(line(i)).margin(0.15));
    CHECK(points[i].deviation > 0);
  }
  std::vector<SmoothedPoint> few(points.begin(), points.begin() + 9);
  for (SmoothedPoint& p : few) p.deviation = 0.1;
  StripeSmoother().smooth(few);
  CHECK(few.front().deviation == 0);
  CHECK(few.back().deviation == 0.1);
}
