#include "services/extraction/stripe_extractor.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "services/extraction/centres/stripe_quality.hpp"
#include "tests/extraction/support/scene_renderer.hpp"
#include "tests/extraction/support/scene_score.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

cv::Mat image_of(double amplitude, double width, double noise, double slope = 0.1,
                 std::uint64_t seed = 1) {
  cv::Mat light = darkness(600, 300);
  add_stripe(light, -20, 120, 620, 120 + 640 * slope, amplitude, width);
  return expose(light, noise, seed);
}

Stripe extract(const cv::Mat& grey, const ExtractionSettings& settings = {}) {
  StripeExtractor extractor(settings);
  return extractor.extract(view_of(grey));
}

std::vector<Centre> chosen(const Stripe& stripe) {
  std::vector<Centre> centres;
  for (const StripeCentre& c : stripe.centres)
    if (c.chosen) centres.push_back({c.u, c.v});
  return centres;
}

bool same(const Stripe& a, const Stripe& b) {
  return a.sigma == b.sigma && a.noise == b.noise &&
         std::equal(a.centres.begin(), a.centres.end(), b.centres.begin(), b.centres.end(),
                    [](const StripeCentre& x, const StripeCentre& y) {
                      return x.u == y.u && x.v == y.v && x.strength == y.strength &&
                             x.width == y.width && x.deviation == y.deviation &&
                             x.segment == y.segment && x.chosen == y.chosen && x.end == y.end;
                    });
}

}  // namespace

TEST_CASE("sigma follows the stripe's width, from the first image on") {
  const double width = GENERATE(1.4, 1.7, 2.5, 4.0, 7.0);
  const Stripe stripe = extract(image_of(160, width, 2));
  CHECK(stripe.empty.empty());
  CHECK(stripe.sigma == Approx(1.3 * width).epsilon(0.15));
  std::vector<float> widths;
  for (const StripeCentre& c : stripe.centres) widths.push_back(c.width);
  REQUIRE(widths.size() > 500);
  std::nth_element(widths.begin(), widths.begin() + 250, widths.end());
  CHECK(widths[250] == Approx(width).epsilon(0.12));
}

TEST_CASE("a saturated stripe is a bar, and gets a sigma that finds its middle") {
  const double half_width = GENERATE(5, 8);
  cv::Mat light = darkness(600, 300);
  for (int row = 0; row < light.rows; ++row)
    for (int column = 0; column < light.cols; ++column) {
      const double across = std::abs(row - 100.3 - 0.2 * column) * std::cos(std::atan(0.2));
      light.at<float>(row, column) +=
          static_cast<float>(400 / (1 + std::exp((across - half_width) / 0.7)));
    }
  const Stripe stripe = extract(expose(light, 2));
  CHECK(stripe.sigma >= half_width / std::sqrt(3.0));
  CHECK(stripe.sigma < 1.2 * half_width);
  CHECK(stripe.saturated_share > 0.98);
  REQUIRE(stripe.centres.size() > 550);
  double squares = 0;
  for (const StripeCentre& c : stripe.centres)
    squares += std::pow((c.v - 100.3 - 0.2 * c.u) * std::cos(std::atan(0.2)), 2);
  CHECK(std::sqrt(squares / stripe.centres.size()) < 0.05);
}

TEST_CASE("sigma follows slowly, and anew after a restart") {
  StripeExtractor extractor(ExtractionSettings{});
  const cv::Mat narrow = image_of(160, 1.6, 2), wide = image_of(160, 3.2, 2);
  const Stripe first = extractor.extract(view_of(narrow));
  const Stripe second = extractor.extract(view_of(wide));
  CHECK(second.sigma == Approx(first.sigma).epsilon(0.1));  // what the image before asked for
  Stripe later;
  for (int i = 0; i < 25; ++i) later = extractor.extract(view_of(wide));
  CHECK(later.sigma == Approx(1.3 * 3.2).epsilon(0.15));
  extractor.restart();
  CHECK(same(extractor.extract(view_of(narrow)), first));
}

TEST_CASE("a sigma that is set stays") {
  ExtractionSettings settings;
  settings.sigma_px = 2.5;
  CHECK(extract(image_of(160, 1.6, 2), settings).sigma == 2.5f);
  CHECK(extract(image_of(160, 4, 2), settings).sigma == 2.5f);
}

TEST_CASE("the strength's exponent never moves a centre") {
  ExtractionSettings settings;
  settings.sigma_px = 2.5;
  const Stripe a = extract(image_of(160, 2, 2), settings);
  settings.strength_exponent = 0;
  settings.least_strength /= std::pow(2.5, 1.5);
  const Stripe b = extract(image_of(160, 2, 2), settings);
  REQUIRE(a.centres.size() == b.centres.size());
  for (std::size_t i = 0; i < a.centres.size(); ++i) {
    REQUIRE(a.centres[i].u == b.centres[i].u);
    REQUIRE(a.centres[i].v == b.centres[i].v);
    REQUIRE(a.centres[i].strength ==
            Approx(std::pow(2.5, 1.5) * b.centres[i].strength).epsilon(1e-4));
  }
}

TEST_CASE("the noise is that of the image") {
  const double noise = GENERATE(0.0, 1.0, 2.5, 6.0);
  const double expected = std::sqrt(noise * noise + 1.0 / 12);
  CHECK(extract(image_of(150, 2, noise)).noise == Approx(expected).epsilon(0.1));
}

TEST_CASE("a surface's own shape is followed, not smoothed as if it were scatter") {
  constexpr double kAmplitude = 8, kWavelength = 120, kWidth = 4;  // px
  const auto crest = [&](double u) {
    return 150 + kAmplitude * std::sin(2 * CV_PI * u / kWavelength);
  };
  cv::Mat light = darkness(600, 300);
  for (int u = 0; u < light.cols; ++u)
    for (int v = 0; v < light.rows; ++v)
      light.at<float>(v, u) +=
          static_cast<float>(150 * std::exp(-0.5 * std::pow((v - crest(u)) / kWidth, 2)));
  const Stripe stripe = extract(expose(light, 2));
  REQUIRE(stripe.centres.size() > 580);
  for (const StripeCentre& c : stripe.centres) CHECK(std::abs(c.v - crest(c.u)) < 0.8);
}

TEST_CASE("a centre's deviation tells its error") {
  const auto check = [](const cv::Mat& grey, double slope, double lowest, double highest) {
    const Stripe stripe = extract(grey);
    double squares = 0, told = 0;
    int count = 0;
    for (const StripeCentre& c : stripe.centres) {
      if (c.u < 20 || c.u > 580) continue;
      squares += std::pow((c.v - 120 - (c.u + 20) * slope) * std::cos(std::atan(slope)), 2);
      told += c.deviation * c.deviation;
      ++count;
    }
    REQUIRE(count > 500);
    CHECK(std::sqrt(squares / told) > lowest);
    CHECK(std::sqrt(squares / told) < highest);
  };
  SECTION("white noise") { check(image_of(80, 2, 5), 0.1, 0.75, 1.25); }
  SECTION("speckle, of which the white-noise law knows nothing") {
    cv::Mat light = darkness(600, 300, 0), grain(300, 600, CV_32F);
    add_stripe(light, -20, 120, 620, 184, 150, 2);
    cv::RNG(4).fill(grain, cv::RNG::NORMAL, 0, 1);
    cv::Mat blurred = grain.clone();  // a grain of 3 px: the mean of 3 x 3
    for (int v = 1; v < 299; ++v)
      for (int u = 1; u < 599; ++u)
        blurred.at<float>(v, u) =
            static_cast<float>(cv::mean(grain(cv::Rect(u - 1, v - 1, 3, 3)))[0]);
    light = light.mul(1 + 0.45 * blurred) + 10;
    check(expose(light, 1), 0.1, 0.6, 1.6);
  }
}

TEST_CASE("a profile's width is that of the Gaussian drawn") {
  const double width = GENERATE(1.3, 2.0, 3.5), angle = GENERATE(0.0, 0.5, 1.3);
  cv::Mat light = darkness(200, 200);
  const double tu = std::cos(angle), tv = std::sin(angle);
  add_stripe(light, 100 - 200 * tu, 100 - 200 * tv, 100 + 200 * tu, 100 + 200 * tv, 180, width);
  std::vector<RidgePoint> points;
  std::vector<int> chain;
  for (int i = -30; i < 30; ++i) {
    const float sense = i % 2 == 0 ? 1 : -1;  // normals have none
    points.push_back({static_cast<float>(100 + i * tu), static_cast<float>(100 + i * tv),
                      static_cast<float>(-sense * tv), static_cast<float>(sense * tu), 1, 0, 0});
    chain.push_back(i + 30);
  }
  std::vector<float> widths(points.size(), -1);
  measure_widths(view_of(expose(light, 1)), points, chain, 1.3 * width, 1, widths);
  for (const float measured : widths) REQUIRE(measured == Approx(width).epsilon(0.1));
  measure_widths(view_of(expose(darkness(200, 200), 1)), points, chain, 1.3 * width, 1, widths);
  for (const float measured : widths) REQUIRE(measured == 0);
}

TEST_CASE("a stripe has centres up to the image's border, straight ones") {
  const Stripe stripe = extract(image_of(160, 2, 2, 0.25));
  REQUIRE(stripe.centres.size() > 590);
  CHECK(stripe.centres.front().u < 3);
  CHECK(stripe.centres.back().u > 596);
  for (const StripeCentre& c : stripe.centres)
    REQUIRE(std::abs(c.v - 120 - 0.25 * (c.u + 20)) < 0.15);
}

TEST_CASE("centres as found are those of the ridge points") {
  ExtractionSettings settings;
  settings.sigma_px = 2.5;
  settings.smooth_course = false;
  const cv::Mat grey = image_of(160, 2, 2);
  const Stripe stripe = extract(grey, settings);
  RidgeDetector detector;
  std::vector<RidgePoint> points;
  detector.detect(view_of(grey), gaussian_kernels(2.5), 0.3, points);
  REQUIRE(stripe.centres.size() > 550);
  // But for the few between two rows or columns.
  const auto between = [](float x) { return std::abs(x - std::round(x)) > 0.4f; };
  for (const StripeCentre& c : stripe.centres)
    REQUIRE((between(c.u) || between(c.v) ||
             std::any_of(points.begin(), points.end(),
                         [&](const RidgePoint& p) { return p.u == c.u && p.v == c.v; })));
}

TEST_CASE("images without a stripe give none, and say so") {
  const auto none = [](const cv::Mat& grey) {
    const Stripe stripe = extract(grey);
    CHECK(stripe.centres.empty());
    CHECK(stripe.why == EmptyStripe::kNoStripe);
    CHECK(stripe.empty == "no stripe found");
  };
  none(cv::Mat());
  none(cv::Mat(1, 1, CV_8U, cv::Scalar(9)));
  none(cv::Mat(2, 500, CV_8U, cv::Scalar(200)));
  none(cv::Mat(400, 3, CV_8U, cv::Scalar(200)));
  none(cv::Mat(300, 400, CV_8U, cv::Scalar(0)));
  none(cv::Mat(300, 400, CV_8U, cv::Scalar(255)));
  none(expose(darkness(400, 300, 40), 3));
  none(expose(darkness(400, 300, 120), 20));
  cv::Mat gradient(300, 400, CV_8U);
  for (int v = 0; v < 300; ++v)
    for (int u = 0; u < 400; ++u)
      gradient.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(u / 2 + v / 6);
  none(gradient);
}

TEST_CASE("the same image gives the same stripe, bit by bit") {
  StripeSceneSettings settings = stripe_scene_settings(StripeSceneKind::kTypical);
  settings.width = 600;
  settings.height = 450;
  const cv::Mat grey = render_stripe_scene(settings, 9).grey;
  CHECK(same(extract(grey), extract(grey)));
}

TEST_CASE("rendered scenes: the stripe and little else, accurately") {
  const auto scene_score = [](StripeSceneKind kind, std::uint64_t seed, double from_corners) {
    const StripeScene scene = render_stripe_scene(stripe_scene_settings(kind), seed);
    return score(scene, chosen(extract(scene.grey)), from_corners);
  };
  const std::uint64_t seed = GENERATE(1, 2);
  INFO("seed " << seed);
  {
    const StripeSceneScore clean = scene_score(StripeSceneKind::kClean, seed, 20);
    CHECK(clean.rms() < 0.01);
    CHECK(clean.recall() > 0.999);
    CHECK(clean.wrong == 0);
  }
  {
    const StripeSceneScore typical = scene_score(StripeSceneKind::kTypical, seed, 0);
    CHECK(typical.rms() < 0.18);
    CHECK(typical.p95() < 0.35);
    CHECK(typical.recall() > 0.98);
    CHECK(typical.false_share() < 0.005);
  }
  {
    const StripeSceneScore saturated = scene_score(StripeSceneKind::kSaturated, seed, 0);
    CHECK(saturated.rms() < 0.18);
    CHECK(saturated.recall() > 0.99);
    CHECK(saturated.false_share() < 0.01);
  }
}

TEST_CASE("on coarse grain the centres are measured at a smaller sigma than they are found at",
          "[figures]") {
  StripeSceneSettings settings = stripe_scene_settings(StripeSceneKind::kLowContrast);
  settings.width = 900;
  settings.height = 500;
  StripeSceneScore once, again;
  for (int seed = 201; seed <= 206; ++seed) {
    const StripeScene scene = render_stripe_scene(settings, static_cast<std::uint64_t>(seed));
    const auto add = [&](StripeSceneScore& total, double measuring) {
      ExtractionSettings extraction;
      extraction.measuring_sigma_per_width = measuring;
      std::vector<Centre> centres;
      for (const StripeCentre& c : StripeExtractor(extraction).extract(view_of(scene.grey)).centres)
        if (c.chosen) centres.push_back({c.u, c.v});
      total.add(score(scene, centres));
    };
    add(once, ExtractionSettings{}.sigma_per_width);
    add(again, ExtractionSettings{}.measuring_sigma_per_width);
  }
  CHECK(again.centres == Approx(once.centres).epsilon(0.01));
  CHECK(again.rms() < 0.95 * once.rms());
}
