// Any number of threads gives the same bytes. A program of its own, so that the thread sanitizer
// has little to build.
#include <atomic>
#include <catch2/catch.hpp>
#include <cstring>
#include <stdexcept>

#include "services/extraction/stripe_extractor.hpp"
#include "tests/extraction/support/scene_renderer.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

// Neither side a multiple of a block; with noise alone every block is looked at.
std::vector<cv::Mat> rendered() {
  std::vector<cv::Mat> all{expose(darkness(301, 155, 128), 40), cv::Mat(40, 30, CV_8U, 7)};
  for (const StripeSceneKind kind : {StripeSceneKind::kTypical, StripeSceneKind::kGlare,
                                     StripeSceneKind::kSaturated, StripeSceneKind::kLowContrast}) {
    StripeSceneSettings scene = stripe_scene_settings(kind);
    scene.width = 607;
    scene.height = 443;
    all.push_back(render_stripe_scene(scene, 3).grey);
  }
  cv::Mat down;  // the stripe runs down the image
  cv::rotate(all.back(), down, cv::ROTATE_90_CLOCKWISE);
  all.push_back(down);
  return all;
}

// Once for all cases: to render them takes longer than to extract.
const std::vector<cv::Mat>& images() {
  static const std::vector<cv::Mat> all = rendered();
  return all;
}

void check_same(const StripeCentre& a, const StripeCentre& b) {
  for (const auto field : {&StripeCentre::u, &StripeCentre::v, &StripeCentre::strength,
                           &StripeCentre::width, &StripeCentre::deviation})
    REQUIRE(std::memcmp(&(a.*field), &(b.*field), sizeof(float)) == 0);
  REQUIRE(a.segment == b.segment);
  REQUIRE(a.chosen == b.chosen);
  REQUIRE(a.end == b.end);
}

}  // namespace

TEST_CASE("ridge points are the same bytes for any number of threads") {
  const GaussianKernels kernels = gaussian_kernels(2.5);
  RidgeDetector one(1), several(GENERATE(2, 3, 7));
  std::size_t seen = 0;
  for (const cv::Mat& grey : images())
    for (const double strong : {0.3, 1.5}) {
      std::vector<RidgePoint> expected, points;
      one.detect_lines(view_of(grey), kernels, 0.25, strong, 2, expected);
      several.detect_lines(view_of(grey), kernels, 0.25, strong, 2, points);
      REQUIRE(points.size() == expected.size());
      static_assert(sizeof(RidgePoint) == 7 * 4, "without gaps");
      if (points.empty()) continue;
      CHECK(std::memcmp(points.data(), expected.data(), points.size() * sizeof(RidgePoint)) == 0);
      seen += points.size();
    }
  CHECK(seen > 10000);
}

TEST_CASE("whether an image has more points than wanted does not depend on the threads") {
  const GaussianKernels kernels = gaussian_kernels(2.5);
  RidgeDetector one(1), several(GENERATE(1, 2, 3, 7));
  for (const cv::Mat& grey : images())
    for (const double strong : {0.3, 1.5}) {
      std::vector<RidgePoint> expected, points;
      one.detect_lines(view_of(grey), kernels, 0.25, strong, 2, expected);
      const std::size_t count = expected.size();
      // What is found twice counts as well: where the limit is is not told here, but that it is
      // one.
      for (const double share : {0.5, 0.99, 1.0, 1.02, 1.1, 1.2, 2.0}) {
        const auto most = static_cast<std::size_t>(share * static_cast<double>(count));
        const bool all = one.detect_lines(view_of(grey), kernels, 0.25, strong, 2, expected, most);
        REQUIRE(several.detect_lines(view_of(grey), kernels, 0.25, strong, 2, points, most) == all);
        if (count > 0) CHECK((share < 1 ? !all : share < 2 || all));
        REQUIRE(points.size() == (all ? count : 0));
        if (!all || count == 0) continue;
        CHECK(several.active_share() == one.active_share());
        CHECK(std::memcmp(points.data(), expected.data(), count * sizeof(RidgePoint)) == 0);
      }
    }
}

TEST_CASE("with more points than wanted the rest of the image is not looked at") {
  RidgeDetector detector(GENERATE(1, 2, 3));
  std::vector<RidgePoint> points;
  const GaussianKernels kernels = gaussian_kernels(2.5);
  const cv::Mat noise = expose(darkness(800, 155, 128), 40);
  REQUIRE(detector.detect_lines(view_of(noise), kernels, 0.25, 1.5, 2, points));
  REQUIRE(detector.active_share() > 0.99);
  const std::size_t count = points.size();
  CHECK_FALSE(detector.detect_lines(view_of(noise), kernels, 0.25, 1.5, 2, points, count / 5));
  CHECK(detector.active_share() < 0.35);
}

TEST_CASE("the stripe is the same for any number of threads") {
  ExtractionSettings settings;
  settings.sigma_px = GENERATE(0.0, 2.5);  // followed, or set
  StripeExtractor one(settings);
  settings.threads = GENERATE(2, 3, 7);
  StripeExtractor several(settings);
  std::size_t seen = 0;
  const auto compare = [&](const cv::Mat& grey) {
    const Stripe expected = one.extract(view_of(grey)), stripe = several.extract(view_of(grey));
    CHECK(stripe.sigma == expected.sigma);
    CHECK(stripe.empty == expected.empty);
    REQUIRE(stripe.centres.size() == expected.centres.size());
    for (std::size_t i = 0; i < stripe.centres.size(); ++i)
      check_same(stripe.centres[i], expected.centres[i]);
    seen += stripe.centres.size();
  };
  for (const cv::Mat& grey : images()) {  // each a scan's first image and its next
    one.restart();
    several.restart();
    compare(grey);
    compare(grey);
  }
  CHECK(seen > 4000);
}

TEST_CASE(
    "a pool's threads take a strip each, again and again, and what one throws comes through") {
  const int size = GENERATE(1, 2, 7);
  ThreadPool pool(size);
  REQUIRE(pool.size() == size);
  std::vector<std::atomic<int>> calls(static_cast<std::size_t>(size));
  for (int round = 0; round < 200; ++round)
    pool.run([&](int strip) { ++calls[static_cast<std::size_t>(strip)]; });
  for (const auto& count : calls) CHECK(count == 200);
  CHECK_THROWS_AS(pool.run([&](int strip) {
    if (strip == size - 1) throw std::runtime_error("the last one");
  }),
                  std::runtime_error);
  pool.run([&](int strip) { ++calls[static_cast<std::size_t>(strip)]; });
  for (const auto& count : calls) CHECK(count == 201);
}

TEST_CASE("strips hold everything once") {
  const int count = GENERATE(0, 1, 6, 7, 1000), strips = GENERATE(1, 2, 7);
  int next = 0;
  for (int strip = 0; strip < strips; ++strip) {
    const StripRange range(count, strip, strips);
    CHECK(range.begin == next);
    CHECK(range.end >= range.begin);
    next = range.end;
  }
  CHECK(next == count);
}
