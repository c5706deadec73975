#include "services/extraction/centres/segment_end_refinement.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "services/extraction/stripe_extractor.hpp"
#include "tests/extraction/support/stripe_image.hpp"

namespace arcstart::extraction {
namespace {

// A stripe that runs in from the left, cut off by an edge through (u, v).
struct CutStripe {
  double u, v, slope;
  double slant_deg;  // between the edge and the stripe's normal
  double width, amplitude;
};

// 5 x 5 samples a pixel, then the lens's blur.
cv::Mat light_of(const CutStripe& s, double blur = 0.8) {
  cv::Mat light = darkness(400, 200);
  const double slant = s.slant_deg * std::numbers::pi / 180, length = std::hypot(1, s.slope);
  const double du = 1 / length, dv = s.slope / length;
  for (int row = 0; row < light.rows; ++row)
    for (int column = 0; column < light.cols; ++column)
      for (int i = 0; i < 25; ++i) {
        const double u = column + (i % 5 - 2) / 5.0 - s.u, v = row + (i / 5 - 2) / 5.0 - s.v;
        const double along = u * du + v * dv, across = v * du - u * dv;
        if (along > across * std::tan(slant)) continue;
        light.at<float>(row, column) += static_cast<float>(
            s.amplitude / 25 * std::exp(-across * across / (2 * s.width * s.width)));
      }
  cv::GaussianBlur(light, light, {}, blur);
  return light;
}

Stripe extracted(const cv::Mat& light, bool as_found, std::uint64_t seed = 1) {
  const cv::Mat image = expose(light, 2, seed);
  ExtractionSettings settings;
  settings.smooth_course = !as_found;
  return StripeExtractor(settings).extract(view_of(image));
}

// The end of a segment next to where the stripe is cut.
StripeCentre end_at(const Stripe& stripe, const CutStripe& s) {
  const StripeCentre* nearest = nullptr;
  const auto distance = [&](const StripeCentre& c) { return std::hypot(c.u - s.u, c.v - s.v); };
  for (const StripeCentre& centre : stripe.centres)
    if (centre.chosen && centre.end != SegmentEnd::kContinues)
      if (!nearest || distance(centre) < distance(*nearest)) nearest = &centre;
  REQUIRE(nearest != nullptr);
  return *nearest;
}

// px square to the edge.
double beyond_edge(const StripeCentre& end, const CutStripe& s) {
  const double along = ((end.u - s.u) + (end.v - s.v) * s.slope) / std::hypot(1, s.slope);
  return along * std::cos(s.slant_deg * std::numbers::pi / 180);
}

}  // namespace

TEST_CASE("a segment ends where an edge cuts off the middle of the stripe", "[figures]") {
  double as_found = 0;
  for (const double slope : {0.05, -0.25, 0.6})
    for (const double width : {1.4, 2.5})
      for (const double slant : {-65, -50, -25, 0, 25, 50, 65}) {
        double sum = 0, most = 0;
        for (int seed = 1; seed <= 5; ++seed) {
          const CutStripe s{250 + 0.23 * seed, 100 + 0.37 * seed, slope, slant, width, 120};
          const cv::Mat light = light_of(s);
          const double beyond = beyond_edge(end_at(extracted(light, false, seed), s), s);
          sum += beyond, most = std::max(most, std::abs(beyond));
          as_found =
              std::max(as_found, std::abs(beyond_edge(end_at(extracted(light, true, seed), s), s)));
        }
        CAPTURE(slope, width, slant);
        CHECK(std::abs(sum / 5) < 0.08);
        CHECK(most < 0.2);
      }
  CHECK(as_found > 1);
}

TEST_CASE("a dark spot before the edge is no end, and a gap's ends are where its light ends") {
  const CutStripe s{250.4, 100.3, 0.2, 20, 1.5, 120};
  cv::Mat light = light_of(s);
  for (int row = 0; row < light.rows; ++row)
    for (int column = 241; column < 244; ++column)
      light.at<float>(row, column) = 10 + 0.1f * (light.at<float>(row, column) - 10);
  CHECK(std::abs(beyond_edge(end_at(extracted(light, false), s), s)) < 0.2);

  // 30 px farther on the stripe comes back.
  const CutStripe after{281, 100.3 + 0.2 * 30.6, 0.2, 0, 1.5, 120};
  cv::Mat mirrored = light_of({light.cols - 1 - after.u, after.v, -0.2, 0, 1.5, 120});
  cv::flip(mirrored, mirrored, 1);
  const Stripe stripe = extracted(light_of(s) + mirrored - 10, false);
  CHECK(std::abs(beyond_edge(end_at(stripe, s), s)) < 0.2);
  CHECK(end_at(stripe, s).end == SegmentEnd::kGap);
  CHECK(std::abs(beyond_edge(end_at(stripe, after), after)) < 0.2);
}

TEST_CASE("an end that cannot be told better stays as found") {
  const CutStripe s{250.4, 100.3, 0.2, 40, 2, 120};
  const auto moved = [&](const cv::Mat& light) {
    return std::abs(end_at(extracted(light, false), s).u - end_at(extracted(light, true), s).u);
  };
  CHECK(moved(light_of(s)) > 1);
  SECTION("for its top is white") {
    CHECK(moved(light_of({s.u, s.v, s.slope, s.slant_deg, s.width, 600})) < 0.5);
  }
  SECTION("for another stripe begins beside it") {
    cv::Mat light = light_of(s);
    add_stripe(light, 250, 93, 390, 37, 120, 2);
    CHECK(moved(light) < 0.5);
  }
  SECTION("for it is short") {
    cv::Mat light = light_of(s);
    light.colRange(0, 228).setTo(10);
    CHECK(moved(light) < 0.5);
  }
}

TEST_CASE("ends that cannot be measured: centres of less than half the strength are beyond") {
  // No light at all, so that no end is seen; a level segment of strength 10, fainter at its ends.
  const cv::Mat dark(200, 400, CV_8U, 7);
  const auto why = GENERATE(SegmentEnd::kGap, SegmentEnd::kSaturation);
  std::vector<StripeCentre> centres;
  for (int k = 0; k < 120; ++k) {
    const float strength = k < 4 ? 4.5f : k >= 117 ? 1.0f : k == 50 ? 2.0f : 10.0f;
    centres.push_back({100.0f + static_cast<float>(k), 90, strength, 3, 0.1f, 2, true,
                       k == 0 || k == 119 ? why : SegmentEnd::kContinues});
  }
  refine_segment_ends(view_of(dark), centres);
  const bool dropped = why == SegmentEnd::kGap;  // elsewhere an end stays as found
  REQUIRE(centres.size() == (dropped ? 113 : 120));
  CHECK(centres.front().u == (dropped ? 104 : 100));
  CHECK(centres.back().u == (dropped ? 216 : 219));
  CHECK(centres.front().end == why);
  CHECK(centres.back().end == why);
  CHECK(std::count_if(centres.begin(), centres.end(),
                      [](const StripeCentre& c) { return c.end != SegmentEnd::kContinues; }) == 2);
}

}  // namespace arcstart::extraction
