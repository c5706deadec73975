#include "services/seam_finding/planes/robust_plane.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

constexpr double kNoise = 0.03;  // mm

// Where the sum of a stripe and its weaker reflection so far beside it is brightest, by search; mm.
double brightest(double reflection, double beside) {
  constexpr double kSigma = 0.35;  // of either; mm
  const auto light = [&](double x) {
    return std::exp(-x * x / (2 * kSigma * kSigma)) +
           reflection * std::exp(-(x - beside) * (x - beside) / (2 * kSigma * kSigma));
  };
  double best = 0;
  for (double x = -0.5; x < 0.5; x += 0.001)
    if (light(x) > light(best)) best = x;
  return best;
}

// A level plate beside a seam along the x axis, 45 mm wide. The reflection moves aside by `moves`
// for each mm from the seam and is not brighter than `reflection` of the stripe.
std::vector<Eigen::Vector3d> plate(double reflection, double moves, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0, kNoise);
  std::vector<Eigen::Vector3d> points;
  for (double x = 0; x < 60; x += 3.6)
    for (double y = 1.5; y < 45; y += 1.2)
      points.emplace_back(x, y, brightest(reflection, moves * y) + noise(engine));
  return points;
}

// Height over the seam's middle; mm.
double at_seam(const std::vector<Eigen::Vector3d>& points) {
  const Line line{{0, 0, 0}, {1, 0, 0}};
  const Plane about{Eigen::Vector3d(0, 0.002, 1).normalized(), 0.02};
  const Plane plane = robust_plane(points, line, about, kNoise);
  return -plane.signed_distance({30, 0, 0}) / plane.normal.z();
}

double least_squares_at_seam(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d terms(1, point.x(), point.y());
    squares += terms * terms.transpose(), products += terms * point.z();
  }
  const Eigen::Vector3d plane = squares.ldlt().solve(products);
  return plane[0] + 30 * plane[1];
}

}  // namespace

// Over many scans.
template <class Height>
double root_mean_square(double reflection, double moves, Height&& height) {
  constexpr int kScans = 30;
  double squares = 0;
  for (unsigned seed = 1; seed <= kScans; ++seed)
    squares += std::pow(height(plate(reflection, moves, seed)), 2);
  return std::sqrt(squares / kScans);
}

TEST_CASE("a reflection that follows the stripe for a way hardly lifts the plate at the seam",
          "[figures]") {
  for (const double moves : {0.02, 0.03, 0.04}) {
    CAPTURE(moves);
    CHECK(root_mean_square(0.2, moves, least_squares_at_seam) > 0.028);
    CHECK(root_mean_square(0.2, moves, at_seam) < 0.02);
  }
}

TEST_CASE("nor does one that leaves the stripe right beside the seam, or that is not there") {
  CHECK(root_mean_square(0.2, 0.2, at_seam) < 0.01);
  CHECK(root_mean_square(0, 0, at_seam) < 0.005);
}

TEST_CASE("too few points give the plane they are given") {
  const Plane about{Eigen::Vector3d::UnitZ(), 0.25};
  const Plane plane =
      robust_plane({{0, 5, 1}, {9, 5, 1}, {0, 9, 1}}, {{0, 0, 0}, {1, 0, 0}}, about, kNoise);
  CHECK(plane.offset == about.offset);
}
