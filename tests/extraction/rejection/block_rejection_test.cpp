// Blocks are left out only where they cannot hold a point.
#include "services/extraction/rejection/block_rejection.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "services/extraction/rejection/curvature_bound.hpp"
#include "services/extraction/rejection/hessian_bound.hpp"
#include "services/extraction/rejection/second_differences.hpp"
#include "services/extraction/ridge/ridge.hpp"
#include "tests/extraction/support/opencv_judge.hpp"
#include "tests/extraction/support/scene_renderer.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

std::vector<RidgePoint> points_of(const cv::Mat& grey, double sigma, double least_curvature) {
  RidgeDetector detector;
  std::vector<RidgePoint> points;
  detector.detect(view_of(grey), gaussian_kernels(sigma), least_curvature, points);
  return points;
}

// Images made to reach far: white where a line's kernel is positive, so that its curvature is the
// largest there can be; and noise, fine and coarse.
std::vector<cv::Mat> hard_images(double sigma) {
  cv::RNG random(11);
  std::vector<cv::Mat> images;
  for (const double angle : {0.0, 0.35, 0.785398, 1.1}) {
    cv::Mat image(121, 121, CV_8U);
    for (int v = 0; v < image.rows; ++v)
      for (int u = 0; u < image.cols; ++u)
        image.at<std::uint8_t>(v, u) =
            std::abs((v - 60) * std::cos(angle) - (u - 60) * std::sin(angle)) < sigma ? 255 : 0;
    images.push_back(image);
  }
  cv::Mat noise(121, 121, CV_8U);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  images.push_back(noise);
  cv::Mat patches(121, 121, CV_8U);
  cv::resize(noise(cv::Rect(0, 0, 30, 30)), patches, patches.size(), 0, 0, cv::INTER_NEAREST);
  images.push_back(patches);
  return images;
}

// max(-xx, -yy) + |xy| of hessian_bound.hpp at every pixel, the known ones two apart.
cv::Mat exact_bend(const cv::Mat& image) {
  const auto row = [](std::initializer_list<double> taps, double divisor) {
    cv::Mat kernel(1, static_cast<int>(taps.size()), CV_64F);
    std::copy(taps.begin(), taps.end(), kernel.begin<double>());
    return cv::Mat(kernel / divisor);
  };
  const cv::Mat binomial = row({1, 4, 6, 4, 1}, 16), second = row({1, 0, 0, 0, -2, 0, 0, 0, 1}, 16),
                mean = row({1, 0, 1, 0, 1}, 3), first = row({-1, 0, -4, 0, 0, 0, 4, 0, 1}, 24);
  cv::Mat smooth, xx, yy, xy;
  const auto filter = [](const cv::Mat& from, cv::Mat& to, const cv::Mat& u, const cv::Mat& v) {
    cv::sepFilter2D(from, to, CV_64F, u, v, {-1, -1}, 0, cv::BORDER_REFLECT_101);
  };
  filter(image, smooth, binomial, binomial);
  filter(smooth, xx, second, mean);
  filter(smooth, yy, mean, second);
  filter(smooth, xy, first, first);
  return cv::max(cv::Mat(-xx), cv::Mat(-yy)) + cv::abs(xy);
}

void check_same_as_judge(const cv::Mat& grey, double sigma, double least_curvature) {
  const GaussianKernels kernels = gaussian_kernels(sigma);
  const auto points = points_of(grey, sigma, least_curvature);
  const auto judge =
      judge_ridge_points(grey, kernels, least_curvature, RidgeDetector::margin(kernels));
  const Verdict verdict = compare(judge, points);
  INFO("sigma " << sigma << ", judged " << verdict.judged << ", found " << points.size());
  CHECK(verdict.missing == 0);
  CHECK(verdict.extra == 0);
  CHECK(verdict.largest_deviation < 0.001);
}

}  // namespace

TEST_CASE("the fast detector finds the same points as five sepFilter2D") {
  cv::RNG random(3);
  // Neither side a multiple of a block or of a tile.
  cv::Mat noise(173, 229, CV_8U), gradient(200, 300, CV_8U), checkerboard(190, 250, CV_8U);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  for (int v = 0; v < gradient.rows; ++v)
    for (int u = 0; u < gradient.cols; ++u)
      gradient.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>((u + v) / 2);
  for (int v = 0; v < checkerboard.rows; ++v)
    for (int u = 0; u < checkerboard.cols; ++u)
      checkerboard.at<std::uint8_t>(v, u) = ((u / 13 + v / 13) % 2) != 0 ? 255 : 0;
  cv::Mat pixels = checkerboard.clone();
  for (int v = 0; v < pixels.rows; ++v)
    for (int u = 0; u < pixels.cols; ++u)
      pixels.at<std::uint8_t>(v, u) = ((u + v) % 2) != 0 ? 255 : 0;
  const double sigma = GENERATE(1.2, 2.5, 5.0);
  const double least = 1.8 / std::pow(sigma, 1.5);

  SECTION("noise alone") { check_same_as_judge(noise, sigma, least); }
  SECTION("faint noise") {
    const cv::Mat faint = expose(darkness(301, 155, 60), 2.5);
    check_same_as_judge(faint, sigma, least / 8);
  }
  SECTION("gradient") { check_same_as_judge(gradient, sigma, 0.02); }
  SECTION("all white") {
    check_same_as_judge(cv::Mat(120, 140, CV_8U, cv::Scalar(255)), sigma, 0.01);
  }
  SECTION("checkerboards") {
    check_same_as_judge(checkerboard, sigma, least);
    check_same_as_judge(pixels, sigma, least);
  }
  SECTION("a stripe just above the threshold, a dot, a step") {
    cv::Mat light = darkness(260, 200, 20);
    const double width = 2;
    const double amplitude =
        1.05 * least * std::pow(width * width + 1.0 / 12 + sigma * sigma, 1.5) / width;
    add_stripe(light, -50, 60, 400, 75, amplitude, width);
    light.at<float>(150, 101) = 255;
    light.colRange(200, 260) += 150;
    check_same_as_judge(expose(light, 0), sigma, least);
    check_same_as_judge(expose(light, 1), sigma, least);
  }
  SECTION("typical and saturated scenes") {
    StripeSceneSettings settings = stripe_scene_settings(StripeSceneKind::kTypical);
    settings.width = 500;
    settings.height = 400;
    check_same_as_judge(render_stripe_scene(settings, 5).grey, sigma, least);
    settings.amplitude = 420;
    check_same_as_judge(render_stripe_scene(settings, 6).grey, sigma, least);
  }
}

TEST_CASE("no second derivative exceeds the bound that rejects blocks") {
  const double sigma = GENERATE(1.2, 2.1, 4.0);
  const GaussianKernels kernels = gaussian_kernels(sigma);
  const CurvatureBound bound = curvature_bound(kernels);
  const std::vector<cv::Mat> images = hard_images(sigma);
  const cv::Mat binomial =
      (cv::Mat_<double>(1, 5) << 1 / 16.0, 4 / 16.0, 6 / 16.0, 4 / 16.0, 1 / 16.0);
  double nearest = 0;
  for (const cv::Mat& image : images) {
    cv::Mat smooth, lowest, highest;
    cv::sepFilter2D(image, smooth, CV_64F, binomial, binomial, {-1, -1}, 0, cv::BORDER_REFLECT_101);
    // Known in every second column and row only: elsewhere what neither is lowest nor highest.
    cv::Mat high = smooth.clone();
    for (int v = 0; v < image.rows; ++v)
      for (int u = 0; u < image.cols; ++u)
        if (u % 2 != 0 || v % 2 != 0) smooth.at<double>(v, u) = 1e9, high.at<double>(v, u) = -1e9;
    const int size = 2 * bound.smoothed_reach + 1;
    cv::erode(smooth, lowest, cv::Mat::ones(size, size, CV_8U));
    cv::dilate(high, highest, cv::Mat::ones(size, size, CV_8U));
    const cv::Mat window = cv::Mat::ones(2 * bound.reach + 1, 2 * bound.reach + 1, CV_8U);
    cv::Mat plain_lowest, plain_highest;
    cv::erode(image, plain_lowest, window);
    cv::dilate(image, plain_highest, window);
    for (const JudgePoint& p :
         judge_ridge_points(image, kernels, 1e-3, RidgeDetector::margin(kernels))) {
      const double range = highest.at<double>(p.row, p.column) - lowest.at<double>(p.row, p.column);
      const double plain = plain_highest.at<std::uint8_t>(p.row, p.column) -
                           plain_lowest.at<std::uint8_t>(p.row, p.column);
      REQUIRE(p.curvature <= bound.highest(range, plain));
      nearest = std::max(nearest, p.curvature / bound.highest(range, plain));
    }
  }
  CHECK(nearest > (sigma > 3 ? 0.85 : sigma > 2 ? 0.65 : 0.25));  // and some come near it
  CHECK(bound.per_grey < (sigma > 2 ? 0.12 : 0.4) * bound.per_smoothed_grey);
}

TEST_CASE("no line is stronger than second differences around allow") {
  const double sigma = GENERATE(2.3, 2.5, 3.3, 5.0);
  const GaussianKernels kernels = gaussian_kernels(sigma);
  const HessianBound bound = hessian_bound(kernels, 10);
  REQUIRE(bound.holds);
  double nearest = 0;
  for (const cv::Mat& image : hard_images(sigma)) {
    cv::Mat bend = exact_bend(image), lowest, highest;
    for (int v = 0; v < image.rows; ++v)
      for (int u = 0; u < image.cols; ++u)
        if (u % 2 != 0 || v % 2 != 0) bend.at<double>(v, u) = -1e9;
    const int size = 2 * bound.reach + 1, range_size = 2 * bound.rest_reach + 1;
    cv::dilate(bend, bend, cv::Mat::ones(size, size, CV_8U));
    cv::erode(image, lowest, cv::Mat::ones(range_size, range_size, CV_8U));
    cv::dilate(image, highest, cv::Mat::ones(range_size, range_size, CV_8U));
    for (const JudgePoint& p :
         judge_ridge_points(image, kernels, 1e-3, RidgeDetector::margin(kernels))) {
      const double range =
          highest.at<std::uint8_t>(p.row, p.column) - lowest.at<std::uint8_t>(p.row, p.column);
      const double most =
          std::max(0.0, bend.at<double>(p.row, p.column)) + bound.per_grey * range + bound.far;
      REQUIRE(p.curvature <= most);
      nearest = std::max(nearest, p.curvature / most);
    }
  }
  // And some come near it; the less near, the more the kernels smooth beyond the differences.
  CHECK(nearest > (sigma > 4 ? 0.3 : sigma > 3 ? 0.45 : 0.6));
}

TEST_CASE("bends in whole numbers fall short of the exact ones by no more than told") {
  for (const cv::Mat& image : hard_images(2.5)) {
    const int cell_columns =
        2 * ((image.cols + BlockRejection::kWidth - 1) / BlockRejection::kWidth);
    SmoothedGrid grid;
    grid.resize(cell_columns, 5);
    grid.smooth(view_of(image), 3);
    CellPlane asked;
    asked.resize(grid.cell_columns(), grid.cell_rows());
    for (int row = 0; row < asked.rows(); ++row)
      std::fill_n(asked.row(row), asked.columns(), std::uint16_t{1});
    SecondDifferences bend;
    bend.measure(grid, asked);
    const cv::Mat exact = exact_bend(image);
    double most_short = -1e9, most_over = -1e9;
    for (int y = SmoothedGrid::kRows; y < 4 * SmoothedGrid::kRows; ++y)
      for (int cell = 0; cell + 2 < cell_columns; ++cell) {
        const int v = 3 * SmoothedGrid::kCellHeight + 2 * y;
        double highest = 0;
        for (int k = 0; k < SmoothedGrid::kColumns; ++k)
          highest = std::max(highest, exact.at<double>(v, cell * SmoothedGrid::kCellWidth + 2 * k));
        const double found = SecondDifferences::kUnit * bend.highest().row(y)[cell];
        most_short = std::max(most_short, highest - found);
        most_over = std::max(most_over, found - highest);
      }
    CHECK(most_short <= SecondDifferences::kShort);
    CHECK(most_over <= SecondDifferences::kShort);
  }
}

TEST_CASE("kernels that smooth too little for second differences are told") {
  CHECK_FALSE(hessian_bound(gaussian_kernels(1.2), 10).holds);
  CHECK_FALSE(hessian_bound(gaussian_kernels(2.2), 10).holds);
}

TEST_CASE("blocks without a stripe are skipped") {
  cv::Mat light = darkness(640, 480);
  add_stripe(light, -10, 200, 650, 230, 150, 1.7);
  const cv::Mat grey = expose(light, 1.5);
  RidgeDetector detector;
  std::vector<RidgePoint> points;
  detector.detect(view_of(grey), gaussian_kernels(2.2), 0.55, points);
  CHECK(points.size() > 600);
  CHECK(detector.active_share() < 0.25);
}
