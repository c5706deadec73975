// The images that stand for real steel are what their declarations say.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "tests/draws.hpp"
#include "tests/extraction/support/steel_scene.hpp"
#include "tests/extraction/support/steel_surface.hpp"

using namespace arcstart::extraction;

namespace {

// Mean of the pixels `low` to `high` px beside the truth, over the visible part of the stripe.
double mean_beside(const cv::Mat& light, const std::vector<TruthPoint>& truth, double low,
                   double high) {
  double sum = 0;
  int count = 0;
  for (const TruthPoint& point : truth) {
    const int u = static_cast<int>(std::lround(point.u));
    if (!point.visible || u >= light.cols) continue;
    for (int v = 0; v < light.rows; ++v)
      if (const double off = std::abs(v - point.v); off >= low && off < high)
        sum += light.at<float>(v, u), ++count;
  }
  return sum / count;
}

// Of the values `along` and `across` px apart.
double correlation(const cv::Mat& values, int along, int across) {
  const cv::Mat a = values(cv::Rect(0, 0, values.cols - along, values.rows - across)),
                b = values(cv::Rect(along, across, values.cols - along, values.rows - across));
  cv::Scalar mean, deviation;
  cv::meanStdDev(values, mean, deviation);
  return cv::mean((a - mean[0]).mul(b - mean[0]))[0] / (deviation[0] * deviation[0]);
}

}  // namespace

TEST_CASE("steel scenes: the laser's light lies where the truth says") {
  const auto kind = static_cast<SteelSceneKind>(GENERATE(range(0, test::draws(4))));
  const SteelScene scene = render_steel_scene(kind, 1 + static_cast<std::uint64_t>(kind) % 2);
  CHECK(scene.turned == (static_cast<int>(kind) % 2 == 0));
  cv::Mat lit, unlit;
  scene.lit.grey.convertTo(lit, CV_32F);
  scene.unlit.convertTo(unlit, CV_32F);
  cv::Mat laser = lit - unlit;
  if (scene.turned) cv::transpose(laser, laser);
  REQUIRE(laser.cols == 1600);
  INFO(name_of(kind));
  const double on = mean_beside(laser, scene.lit.truth, 0, 1.5);
  CHECK(on > 25);
  CHECK(on > 1.01 * mean_beside(laser, scene.lit.truth, 1.5, 3));
  CHECK(on > 8 * mean_beside(laser, scene.lit.truth, 70, 100));
}

TEST_CASE("steel surfaces: of mean 1, of a contrast as photographs have it") {
  const auto kind = static_cast<SteelSurface>(GENERATE(range(0, test::draws(9))));
  INFO(name_of(kind));
  const SurfaceLight light = render_surface(kind, {400, 300}, 0, 5);
  REQUIRE(light.reflectance.size() == cv::Size(400, 300));
  cv::Scalar mean, deviation;
  cv::meanStdDev(light.reflectance, mean, deviation);
  CHECK(mean[0] == Approx(1).epsilon(1e-4));
  CHECK(deviation[0] > 0.03);
  CHECK(deviation[0] < 0.30);
  double least = 0;
  cv::minMaxLoc(light.reflectance, &least);
  CHECK(least > 0);
}

TEST_CASE("steel surfaces: a ground one has its grain along the lay, at any angle") {
  const cv::Mat level = render_surface(SteelSurface::kGround, {400, 400}, 0, 5).reflectance;
  CHECK(correlation(level, 10, 0) > 0.7);
  CHECK(correlation(level, 0, 10) < 0.2);
  const cv::Mat slanting =
      render_surface(SteelSurface::kGround, {400, 400}, CV_PI / 4, 5).reflectance;
  CHECK(correlation(slanting, 10, 10) > 0.7);
  CHECK(correlation(slanting, 10, 0) < 0.2);
}

TEST_CASE("a printed chessboard has two greys and fields of the size asked for") {
  const cv::Mat print = render_print({400, 400}, 40, 0, 0.2);
  CHECK(print.at<float>(20, 20) == Approx(1).margin(0.01));
  CHECK(print.at<float>(20, 60) == Approx(0.2).margin(0.01));
  CHECK(print.at<float>(60, 60) == Approx(1).margin(0.01));
}
