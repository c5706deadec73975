#include "services/extraction/ridge/ridge.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "services/extraction/centres/stripe_quality.hpp"
#include "tests/extraction/support/opencv_judge.hpp"
#include "tests/extraction/support/scene_renderer.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

std::vector<RidgePoint> detect(const cv::Mat& grey, double sigma, double least_curvature) {
  RidgeDetector detector;
  std::vector<RidgePoint> points;
  detector.detect(view_of(grey), gaussian_kernels(sigma), least_curvature, points);
  return points;
}

// A stripe through the middle of a square image, at an angle, moved sideways by a fraction of a
// pixel.
struct Line {
  double angle, shift;
  static constexpr int kSize = 240;
  double tu() const { return std::cos(angle); }
  double tv() const { return std::sin(angle); }
  double distance(double u, double v) const {
    return (v - kSize / 2) * tu() - (u - kSize / 2) * tv() - shift;
  }
  cv::Mat draw(double amplitude, double width) const {
    cv::Mat light = darkness(kSize, kSize);
    const double u = kSize / 2 - shift * tv(), v = kSize / 2 + shift * tu();
    add_stripe(light, u - 400 * tu(), v - 400 * tv(), u + 400 * tu(), v + 400 * tv(), amplitude,
               width);
    return light;
  }
};

}  // namespace

TEST_CASE("a Gaussian stripe's centre, normal and curvature are those of the closed form") {
  const double angle = GENERATE(0.0, 0.17, 0.6, 0.785398, 1.2, 1.5708, 2.2, 2.9);
  const double width = GENERATE(1.65, 3.0), sigma = GENERATE(1.5, 2.5, 4.0);
  const double amplitude = 200;
  const Line line{angle, 0.3};
  const cv::Mat grey = expose(line.draw(amplitude, width), 0);
  const double variance =
      width * width + sigma * sigma + 2.0 / 12;  // a pixel's in image and kernel
  const double curvature = amplitude * width / std::pow(variance, 1.5);
  const auto points = detect(grey, sigma, 0.2 * curvature);
  CHECK(points.size() > 200);
  for (const RidgePoint& p : points) {
    const int from_border =
        std::min({p.column, p.row, Line::kSize - 1 - p.column, Line::kSize - 1 - p.row});
    if (from_border < 4 * sigma) continue;  // nearer, the mirrored image bends the line a little
    // One Newton step from the pixel's centre, t beside the line, leaves t^3 / variance.
    const double start = std::abs(line.distance(p.column, p.row));
    REQUIRE(std::abs(line.distance(p.u, p.v)) < 0.015 + 1.2 * std::pow(start, 3) / variance);
    REQUIRE(std::abs(p.normal_u * line.tu() + p.normal_v * line.tv()) < 0.02);
    // The Hessian is taken at the pixel's centre, a fraction of a pixel beside the line.
    const double beside = std::pow(line.distance(p.column, p.row), 2) / variance;
    REQUIRE(p.curvature == Approx(curvature * (1 - beside) * std::exp(-beside / 2)).epsilon(0.02));
    REQUIRE(std::hypot(p.normal_u, p.normal_v) == Approx(1).margin(1e-5));
    REQUIRE(std::abs(p.u - p.column) <= 0.5001);
    REQUIRE(std::abs(p.v - p.row) <= 0.5001);
  }
}

TEST_CASE("points come in raster order, none nearer to the border than the margin") {
  const Line line{0.5, 0.1};
  const double sigma = 2;
  const auto points = detect(expose(line.draw(150, 2), 3), sigma, 0.3);
  REQUIRE(points.size() > 100);
  for (std::size_t i = 1; i < points.size(); ++i)
    REQUIRE(std::pair(points[i - 1].row, points[i - 1].column) <
            std::pair(points[i].row, points[i].column));
  for (const RidgePoint& p : points)
    REQUIRE(std::min({p.column, p.row, Line::kSize - 1 - p.column, Line::kSize - 1 - p.row}) >= 4);
}

TEST_CASE("a line is found where the kernels reach over the image's border, without bend") {
  const Line line{0.3, 0};
  const auto points = detect(expose(line.draw(200, 2), 0), 4, 1);
  int near_border = 0;
  for (const RidgePoint& p : points) {
    near_border += p.column < 14;
    REQUIRE(std::abs(line.distance(p.u, p.v)) < 0.04);
  }
  CHECK(near_border >= 5);
}

TEST_CASE("strength is largest where sigma is the stripe's width, and never moves a centre") {
  const double width = GENERATE(1.5, 2.5, 4.0);
  const Line line{0.2, 0.25};
  const cv::Mat grey = expose(line.draw(200, width), 0);
  const auto strength = [&](double sigma, double exponent) {
    const auto points = detect(grey, sigma, 0.3);
    std::vector<float> curvatures;
    for (const RidgePoint& p : points) curvatures.push_back(p.curvature);
    std::sort(curvatures.begin(), curvatures.end());
    return strength_factor(sigma, exponent) * curvatures.at(curvatures.size() / 2);
  };
  const double seen = std::sqrt(width * width + 1.0 / 12);
  double best = 0, highest = 0, best_of_two = 0, highest_of_two = 0;
  for (double sigma = 0.5 * width; sigma < 2 * width; sigma *= 1.03) {
    if (const double s = strength(sigma, 1.5); s > highest) highest = s, best = sigma;
    if (const double s = strength(sigma, 2); s > highest_of_two)
      highest_of_two = s, best_of_two = sigma;
  }
  CHECK(best == Approx(seen).epsilon(0.1));
  CHECK(best_of_two == Approx(std::sqrt(2.0) * seen).epsilon(0.1));
  CHECK(highest == Approx(200 / (std::pow(2, 1.5) * std::sqrt(width))).epsilon(0.08));
}

TEST_CASE("under white noise the centres scatter as the law says") {
  const double angle = GENERATE(0.0, 0.4, 0.785398, 1.3), noise = GENERATE(2.0, 7.0);
  const double width = 2.5, sigma = GENERATE(2.5, 3.5), amplitude = 140;
  const Line line{angle, 0.3};
  const cv::Mat light = line.draw(amplitude, width);
  double squares = 0, law = 0;
  int count = 0;
  for (int seed = 1; seed <= 6; ++seed)
    for (const RidgePoint& p : detect(expose(light, noise, seed), sigma, 2)) {
      if (std::abs(line.distance(p.u, p.v)) > 2) continue;
      squares += std::pow(line.distance(p.u, p.v), 2);
      law += centre_deviation(p.curvature, sigma, noise);
      ++count;
    }
  REQUIRE(count > 1000);
  const double rms = std::sqrt(squares / count);
  CHECK(rms <= 1.15 * law / count + 0.003);
  CHECK(rms >= 0.85 * law / count);
  CHECK(law / count == Approx(0.1995 * noise * std::pow(width * width + sigma * sigma, 1.5) /
                              (amplitude * width * sigma * sigma))
                           .epsilon(0.05));
}

TEST_CASE("dark lines are not taken for bright ones") {
  cv::Mat grey = expose(Line{0.4, 0}.draw(100, 2), 0);
  const cv::Mat dark = 200 - grey;
  for (const RidgePoint& p : detect(dark, 2, 0.5))
    REQUIRE(std::abs(Line{0.4, 0}.distance(p.u, p.v)) > 3);  // the dark line's bright sides at most
}

TEST_CASE("lines are found whole wherever one of their points is strong") {
  const double sigma = GENERATE(1.5, 2.5, 4.0);
  StripeSceneSettings settings = stripe_scene_settings(StripeSceneKind::kTypical);
  settings.width = 500;
  settings.height = 400;
  const cv::Mat grey = render_stripe_scene(settings, GENERATE(3, 4)).grey;
  const GaussianKernels kernels = gaussian_kernels(sigma);
  const double strong = 4 / std::pow(sigma, 1.5), weak = 0.3 * strong;
  RidgeDetector detector;
  std::vector<RidgePoint> all, lines;
  detector.detect(view_of(grey), kernels, weak, all);
  const double all_share = detector.active_share();
  detector.detect_lines(view_of(grey), kernels, weak, strong, RidgeDetector::margin(kernels),
                        lines);
  if (sigma > 2) CHECK(detector.active_share() < all_share);

  // Grown from the strong points over neighbours, by brute force.
  std::vector<char> wanted(all.size(), 0);
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].curvature >= strong) wanted[i] = 1, front.push_back(i);
  REQUIRE(front.size() > 100);
  while (!front.empty()) {
    const RidgePoint p = all[front.back()];
    front.pop_back();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (wanted[i] == 0 && std::abs(all[i].column - p.column) <= RidgeDetector::kLineReach &&
          std::abs(all[i].row - p.row) <= RidgeDetector::kLineReach)
        wanted[i] = 1, front.push_back(i);
  }
  std::size_t at = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    while (at < lines.size() &&
           std::pair(lines[at].row, lines[at].column) < std::pair(all[i].row, all[i].column))
      ++at;
    const bool found =
        at < lines.size() && lines[at].row == all[i].row && lines[at].column == all[i].column;
    if (wanted[i] != 0) REQUIRE(found);
    if (found) REQUIRE((lines[at].u == all[i].u && lines[at].curvature == all[i].curvature));
  }
}

TEST_CASE("images of any size are taken") {
  const int width = GENERATE(1, 2, 3, 16, 17, 33), height = GENERATE(1, 2, 19, 40);
  const cv::Mat grey(height, width, CV_8U, cv::Scalar(255));
  CHECK(detect(grey, 2.5, 0.1).empty());
  cv::Mat lit = cv::Mat::zeros(height, width, CV_8U);
  lit.row(height / 2) = 255;
  const auto points = detect(lit, 2.5, 0.1);
  if (width > 19 && height > 19)
    CHECK(points.size() == static_cast<std::size_t>(width) - 10);
  else
    CHECK(points.empty());
}
