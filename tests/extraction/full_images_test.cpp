// Images that are full of lines: a calibration plate in front of the camera.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "services/extraction/lines/linking.hpp"
#include "services/extraction/stripe_extractor.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

constexpr int kFullWidth = 1600, kFullHeight = 1200;

cv::Mat checkers(int field, double dark, double bright) {
  cv::Mat light(kFullHeight, kFullWidth, CV_32F);
  light.forEach<float>([&](float& value, const int* at) {
    value = static_cast<float>((at[0] / field + at[1] / field) % 2 != 0 ? bright : dark);
  });
  return light;
}

}  // namespace

TEST_CASE("an image of more ridge points than can be told apart is refused, and says so") {
  ExtractionSettings settings;
  settings.sigma_px = GENERATE(0.0, 2.5);  // 0: as it follows
  StripeExtractor extractor(settings);
  // Of 8 px, at sigma 2.5: as many points as an eighth of the pixels.
  const Stripe stripe = extractor.extract(view_of(expose(checkers(8, 0, 255), 0)));
  CHECK(stripe.centres.empty());
  CHECK(stripe.why == EmptyStripe::kTooMuchLight);
  CHECK(stripe.empty == "more than 153600 ridge points, too many to tell a stripe from");
  // The next image is looked at anew.
  cv::Mat light = darkness(kFullWidth, kFullHeight);
  add_stripe(light, -20, 500, kFullWidth + 20, 700, 150, 2);
  const Stripe next = extractor.extract(view_of(expose(light, 2)));
  CHECK(next.why == EmptyStripe::kNone);
  CHECK(next.empty.empty());
  CHECK(next.centres.size() > 1500);
}

TEST_CASE("a stripe in front of a plate full of edges is found") {
  const int field = GENERATE(16, 20);
  cv::Mat light = checkers(field, 10, 70);
  const double slope = 0.1;
  add_stripe(light, -20, 500 - 20 * slope, kFullWidth + 20, 500 + (kFullWidth + 20) * slope, 180,
             2.5);
  const cv::Mat grey = expose(light, 2);

  // Far more than is kept of them:
  const GaussianKernels kernels = gaussian_kernels(2.5);
  const double strong = 4 / strength_factor(2.5, 1.5);
  std::vector<RidgePoint> points;
  RidgeDetector().detect_lines(view_of(grey), kernels, 0.45 * strong, strong, 2, points);
  std::vector<Chain> chains;
  Linker().link(points, {strong, 10}, chains);
  std::size_t all = 0;
  for (const Chain& chain : chains) all += chain.size();
  REQUIRE(all > 30 * kFullWidth);

  const Stripe stripe = StripeExtractor(ExtractionSettings{}).extract(view_of(grey));
  std::vector<char> found(kFullWidth, 0);
  int chosen = 0, beside = 0;
  for (const StripeCentre& c : stripe.centres) {
    if (!c.chosen) continue;
    ++chosen;
    const bool on_stripe = std::abs(c.v - 500 - slope * c.u) < 3;
    beside += !on_stripe;
    if (on_stripe) found[std::clamp(static_cast<int>(std::lround(c.u)), 0, kFullWidth - 1)] = 1;
  }
  CHECK(std::count(found.begin(), found.end(), 1) > 0.9 * kFullWidth);
  CHECK(beside < 0.02 * chosen);
}
