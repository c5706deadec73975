// What is chosen of images in which more than the stripe is to be seen.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "services/extraction/stripe_extractor.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

constexpr double kLineSigma = 1.8;

struct Sides {
  double u0, v0, u1, v1, amplitude;
  double distance(double u, double v) const {
    const double length = std::hypot(u1 - u0, v1 - v0), tu = (u1 - u0) / length,
                 tv = (v1 - v0) / length;
    const double along = std::clamp((u - u0) * tu + (v - v0) * tv, 0.0, length);
    return std::hypot(u - u0 - along * tu, v - v0 - along * tv);
  }
};

// Scenes are drawn as they lie, or with rows and columns exchanged: the stripe then runs down the
// image.
struct Drawing {
  std::vector<Sides> stripe, others;
  bool down = false;
  int width = 800, height = 400;
  double line = kLineSigma;  // sigma; px

  cv::Mat grey(double noise = 2) const {
    cv::Mat light = darkness(width, height);
    for (const auto* pieces : {&stripe, &others})
      for (const Sides& s : *pieces) add_stripe(light, s.u0, s.v0, s.u1, s.v1, s.amplitude, line);
    cv::Mat image = expose(light, noise);
    if (down) image = image.t();
    return image;
  }
};

Stripe stripe_of(const cv::Mat& grey) {
  StripeExtractor extractor(ExtractionSettings{});
  return extractor.extract(view_of(grey));
}

struct Result {
  int chosen = 0, on_stripe = 0, false_ones = 0, seconds = 0, segments = 0;
  double covered = 0;  // share of the stripe's columns with a chosen centre within 2 px
};

Result judge(const Drawing& drawing, const Stripe& stripe) {
  Result result;
  std::vector<char> covered(drawing.width, 0);
  for (const StripeCentre& c : stripe.centres) {
    if (!c.chosen) {
      ++result.seconds;
      continue;
    }
    const double u = drawing.down ? c.v : c.u, v = drawing.down ? c.u : c.v;
    double nearest = 1e9;
    for (const Sides& s : drawing.stripe) nearest = std::min(nearest, s.distance(u, v));
    ++result.chosen;
    result.segments = std::max(result.segments, c.segment + 1);
    if (nearest < 2) {
      ++result.on_stripe;
      covered[std::clamp(static_cast<int>(std::lround(u)), 0, drawing.width - 1)] = 1;
    } else if (nearest > 3) {
      ++result.false_ones;
    }
  }
  int wanted = 0, found = 0;
  for (const Sides& s : drawing.stripe)
    for (int u = static_cast<int>(std::ceil(std::max(s.u0, 6.0)));
         u < std::min(s.u1, drawing.width - 6.0); ++u) {
      ++wanted;
      found += covered[u];
    }
  result.covered = static_cast<double>(found) / wanted;
  return result;
}

}  // namespace

TEST_CASE("a ghost stripe is a second candidate, also where the stripe has a gap") {
  Drawing drawing;
  drawing.down = GENERATE(false, true);
  const double gap = GENERATE(0, 16, 40, 70), beside = GENERATE(-60, 45, 90);
  drawing.stripe = {{-5, 180, 400, 200, 140}, {400 + gap, 200, 805, 215, 140}};
  drawing.others = {{320, 196 + beside, 560, 206 + beside, 0.35 * 140}};
  const Stripe stripe = stripe_of(drawing.grey());
  const Result result = judge(drawing, stripe);
  INFO("gap " << gap << ", ghost " << beside << " px beside");
  CHECK(result.false_ones == 0);
  CHECK(result.covered > 0.97);
  CHECK(result.seconds > 200);
  CHECK(result.segments == (gap == 0 ? 1 : 2));
}

TEST_CASE("no column has two chosen centres, and no gap is filled") {
  Drawing drawing;
  const double gap = GENERATE(10, 30, 69);
  drawing.stripe = {{-5, 100, 300, 140, 120}, {300 + gap, 140 + 0.13 * gap, 805, 240, 120}};
  const Stripe stripe = stripe_of(drawing.grey());
  std::vector<int> in_column(drawing.width, 0);
  for (const StripeCentre& c : stripe.centres) {
    if (!c.chosen) continue;
    REQUIRE(++in_column[static_cast<int>(std::lround(c.u))] == 1);
    REQUIRE((c.u < 303 || c.u > 297 + gap));
  }
  REQUIRE(stripe.centres.size() > 600);
  INFO("gap " << gap);
  // Both ends at the gap say so; the outer ones lie at the border.
  std::vector<SegmentEnd> ends;
  for (const StripeCentre& c : stripe.centres)
    if (c.end != SegmentEnd::kContinues) ends.push_back(c.end);
  CHECK(ends ==
        std::vector{SegmentEnd::kBorder, SegmentEnd::kGap, SegmentEnd::kGap, SegmentEnd::kBorder});
}

TEST_CASE("where one surface hides another, both stripes are followed to their ends") {
  // A weak stripe begins in the columns in which a strong one ends, far across.
  Drawing drawing;
  const double overlap = GENERATE(0, 2, 4);
  drawing.stripe = {{-5, 100, 400 + overlap, 120, 120}, {400, 300, 805, 420, 45}};
  const Stripe stripe = stripe_of(drawing.grey());
  float first_end = 0, second_begin = 1000;
  for (const StripeCentre& c : stripe.centres) {
    if (!c.chosen) continue;
    if (c.v < 200) first_end = std::max(first_end, c.u);
    if (c.v > 200) second_begin = std::min(second_begin, c.u);
  }
  INFO("overlap " << overlap);
  CHECK(first_end == Approx(400 + overlap).margin(1.5));
  CHECK(second_begin == Approx(400).margin(1.5));
}

TEST_CASE("the profile of a Tee joint is followed around its corner, not along the reflection") {
  // The base plate rises to the corner and the upright plate falls from it; each plate mirrors the
  // other's stripe, and the reflection leaves the corner nearly in the direction in which the
  // stripe has come.
  Drawing drawing;
  drawing.down = GENERATE(false, true);
  const double bright = GENERATE(140, 70);
  drawing.stripe = {{-5, 120, 90, 125, 110},       // table
                    {90, 150, 400, 248, 140},      // base plate
                    {400, 248, 620, 134, bright},  // upright plate
                    {620, 80, 805, 86, 110}};      // table behind
  drawing.others = {{400, 248, 560, 331, 0.35 * 140}, {260, 320, 400, 248, 0.2 * bright}};
  const Result result = judge(drawing, stripe_of(drawing.grey()));
  CHECK(result.false_ones <= 2);
  CHECK(result.covered > 0.975);
  CHECK(result.seconds > 100);
  CHECK(result.segments >= 3);
}

TEST_CASE("steps, and pieces of 40 px between them, are kept") {
  Drawing drawing;
  drawing.down = GENERATE(false, true);
  drawing.stripe = {{-5, 100, 300, 105, 120}, {300, 180, 340, 181, 120}, {340, 250, 805, 262, 120}};
  const Stripe stripe = stripe_of(drawing.grey());
  const Result result = judge(drawing, stripe);
  CHECK(result.false_ones == 0);
  CHECK(result.covered > 0.97);
  CHECK(result.segments == 3);
  int edges = 0;
  for (const StripeCentre& c : stripe.centres) edges += c.end == SegmentEnd::kEdge;
  CHECK(edges == 4);
}

TEST_CASE("in a coarse image a short surface is followed, not the reflection that leads on") {
  Drawing drawing;
  drawing.width = 400, drawing.height = 300, drawing.line = 0.8;
  drawing.stripe = {{-5, 197, 211, 147, 150}, {212, 148, 252, 169.3, 120}, {285, 114, 405, 80, 60}};
  drawing.others = {{212, 145, 280, 115, 40}};
  const Stripe stripe = stripe_of(drawing.grey());
  const auto on_surface =
      std::count_if(stripe.centres.begin(), stripe.centres.end(), [&](const StripeCentre& centre) {
        return centre.chosen && centre.u > 216 &&
               drawing.stripe[1].distance(centre.u, centre.v) < 1;
      });
  CHECK(on_surface > 30);
}

TEST_CASE("a dim piece of the stripe is kept beside bright ones") {
  Drawing drawing;
  drawing.stripe = {{-5, 100, 400, 120, 180}, {400, 170, 805, 150, 20}};
  const Result result = judge(drawing, stripe_of(drawing.grey()));
  CHECK(result.false_ones == 0);
  CHECK(result.covered > 0.97);
}

TEST_CASE("blobs and short streaks draw the stripe nowhere") {
  Drawing drawing;
  drawing.stripe = {{-5, 200, 350, 210, 100}, {410, 212, 805, 223, 100}};
  cv::Mat light = darkness(drawing.width, drawing.height);
  for (const Sides& s : drawing.stripe)
    add_stripe(light, s.u0, s.v0, s.u1, s.v1, s.amplitude, kLineSigma);
  const auto add_blob = [&](double u, double v, double a, double b) {
    for (int row = 0; row < light.rows; ++row)
      for (int column = 0; column < light.cols; ++column)
        light.at<float>(row, column) += static_cast<float>(
            250 * std::exp(-std::pow((column - u) / a, 2) / 2 - std::pow((row - v) / b, 2) / 2));
  };
  add_blob(380, 60, 14, 5);   // above the gap
  add_blob(380, 330, 10, 8);  // below it
  add_blob(200, 260, 15, 4);
  add_blob(600, 100, 6, 10);
  add_stripe(light, 500, 300, 525, 320, 200, 1.2);
  const Result result = judge(drawing, stripe_of(expose(light, 2)));
  CHECK(result.false_ones == 0);
  CHECK(result.covered > 0.97);
}
