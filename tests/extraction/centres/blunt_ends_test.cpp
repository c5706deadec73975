// Ends of stripes, most of them wide and white, at steps of the surface.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "services/extraction/stripe_extractor.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

constexpr int kWidth = 300, kHeight = 400;
constexpr double kHalfWidth = 9;     // px
constexpr double kEndOfLight = 250;  // row

// Runs down the image and ends in a semicircle of light.
struct Course {
  double middle, slope, begin, end;  // px, px / px, rows
  double at(double row) const { return middle + slope * row; }
};

void add_blunt_stripe(cv::Mat& light, const Course& course, double half_width) {
  const double length = std::hypot(1, course.slope);
  for (int v = 0; v < light.rows; ++v)
    for (int u = 0; u < light.cols; ++u) {
      const double row = std::clamp((v + course.slope * (u - course.middle)) / length / length,
                                    course.begin, course.end);
      const double distance = std::hypot(u - course.at(row), v - row);
      light.at<float>(v, u) +=
          static_cast<float>(420 / (1 + std::exp((distance - half_width) / 0.8)));
    }
}

struct Ends {
  int rows = 0, found = 0;
  double worst = 0;           // px, across
  double worst_in_sigma = 0;  // of what is stated
};

// In the last rows that are white over 7 px and more. beside: how far off a narrower stripe begins
// where this one ends; px, 0 for none.
Ends look_at(double slope, double beside, bool smooth_course) {
  cv::Mat light = darkness(kWidth, kHeight, 20);
  const Course course{150 - slope * 200, slope, -50, kEndOfLight - kHalfWidth};
  add_blunt_stripe(light, course, kHalfWidth);
  if (beside > 0)
    add_blunt_stripe(
        light, {course.at(kEndOfLight) + beside - slope * kEndOfLight, slope, kEndOfLight + 6, 500},
        6);
  const cv::Mat grey = expose(light, 2);
  ExtractionSettings settings;
  settings.smooth_course = smooth_course;
  const Stripe stripe = StripeExtractor(settings).extract(view_of(grey));
  Ends ends;
  for (int row = static_cast<int>(kEndOfLight) - 20; row < kEndOfLight; ++row) {
    if (cv::countNonZero(grey.row(row).colRange(0, static_cast<int>(course.at(row)) + 11) >= 250) <
        7)
      continue;
    ++ends.rows;
    for (const StripeCentre& c : stripe.centres) {
      if (!c.chosen || std::lround(c.v) != row || std::abs(c.u - course.at(c.v)) > 5) continue;
      ++ends.found;
      const double off = std::abs(c.u - course.at(c.v)) / std::hypot(1, slope);
      ends.worst = std::max(ends.worst, off);
      ends.worst_in_sigma = std::max(ends.worst_in_sigma, off / static_cast<double>(c.deviation));
      break;
    }
  }
  return ends;
}

}  // namespace

TEST_CASE("a white stripe has centres up to its blunt end, also where another begins beside it") {
  for (const bool smooth_course : {false, true})
    for (const double slope : {0.0, 0.2, -0.45})
      for (const double beside : {0.0, 26.0, 30.0}) {
        const Ends ends = look_at(slope, beside, smooth_course);
        INFO("slope " << slope << ", beside " << beside << ", smooth " << smooth_course
                      << ": found " << ends.found << " of " << ends.rows << ", worst " << ends.worst
                      << " px, " << ends.worst_in_sigma << " of its deviation");
        CHECK(ends.rows >= 16);
        CHECK(ends.found >= ends.rows - 2);
        CHECK(ends.worst < 1.5);
      }
}

TEST_CASE("segments end at the border, and in white") {
  cv::Mat light = darkness(600, 300);
  add_stripe(light, -20, 150, 620, 150, 150, 2);
  light.colRange(300, 420) += 300;  // over the whole height: nothing to be seen there
  const cv::Mat image = expose(light, 2);
  const Stripe stripe = StripeExtractor(ExtractionSettings{}).extract(view_of(image));
  std::vector<SegmentEnd> ends;
  for (const StripeCentre& c : stripe.centres)
    if (c.chosen && c.end != SegmentEnd::kContinues) ends.push_back(c.end);
  CHECK(ends == std::vector{SegmentEnd::kBorder, SegmentEnd::kSaturation, SegmentEnd::kSaturation,
                            SegmentEnd::kBorder});
}
