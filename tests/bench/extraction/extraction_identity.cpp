#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/extraction/extraction_bench.hpp"
#include "tests/extraction/support/opencv_judge.hpp"
#include "tests/extraction/support/scene_renderer.hpp"
#include "tests/extraction/support/stripe_image.hpp"

namespace arcstart {

using namespace extraction;
namespace {

constexpr int kWidth = 1600, kHeight = 1200;

class Comparison {
 public:
  void add(const std::string& name, const cv::Mat& grey, double sigma, double strength) {
    const extraction::GaussianKernels kernels = extraction::gaussian_kernels(sigma);
    const double least = strength / extraction::strength_factor(sigma, 1.5);
    detector_.detect(view_of(grey), kernels, least, points_);
    const Verdict verdict = compare(
        judge_ridge_points(grey, kernels, least, extraction::RidgeDetector::margin(kernels)),
        points_);
    fmt::print("{:<24} {:5.2f} {:9} {:8} {:8} {:12.7f} {:8.1f}\n", name, sigma, verdict.judged,
               verdict.missing, verdict.extra, verdict.largest_deviation,
               100 * detector_.active_share());
    std::fflush(stdout);
    total_.judged += verdict.judged;
    total_.missing += verdict.missing;
    total_.extra += verdict.extra;
    total_.largest_deviation = std::max(total_.largest_deviation, verdict.largest_deviation);
  }
  const Verdict& total() const { return total_; }

 private:
  extraction::RidgeDetector detector_;
  std::vector<extraction::RidgePoint> points_;
  Verdict total_;
};

template <class Grey>
cv::Mat made_of(Grey grey) {
  cv::Mat image(kHeight, kWidth, CV_8U);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(grey(u, v));
  return image;
}

}  // namespace

void bench_identity(int seeds, nlohmann::json& json) {
  fmt::print(
      "\nIdentity with the plain form (five sepFilter2D in double precision). Left out: points of "
      "the plain form within 1e-3\nrelative of the strength threshold, 1e-3 px of the offset's "
      "limit, or without a definite normal.\n{:<24} {:>5} {:>9} {:>8} {:>8} {:>12} {:>8}\n",
      "", "sigma", "points", "missing", "extra", "deviation px", "active %");
  Comparison comparison;
  constexpr double kStrength = 1.5;
  for (const StripeSceneKind kind : kAllStripeScenes)
    for (int seed = 1; seed <= seeds; ++seed)
      comparison.add(
          fmt::format("{} seed {}", name_of(kind), seed),
          render_stripe_scene(stripe_scene_settings(kind), static_cast<std::uint64_t>(seed)).grey,
          2.5, kStrength);
  for (const double sigma : {1.2, 2.5, 5.0}) {
    comparison.add("noise alone", expose(darkness(kWidth, kHeight, 60), 4), sigma, kStrength / 4);
    comparison.add("heavy noise alone", expose(darkness(kWidth, kHeight, 128), 40), sigma,
                   kStrength);
    comparison.add("gradient", made_of([](int u, int v) { return (u + v) / 11; }), sigma, 0.05);
    comparison.add("all white", made_of([](int, int) { return 255; }), sigma, 0.01);
    comparison.add("checkerboard 13 px",
                   made_of([](int u, int v) { return ((u / 13 + v / 13) % 2) != 0 ? 255 : 0; }),
                   sigma, kStrength);
    comparison.add("checkerboard 1 px",
                   made_of([](int u, int v) { return ((u + v) % 2) != 0 ? 255 : 0; }), sigma,
                   kStrength);
    cv::Mat light = darkness(kWidth, kHeight, 20);
    const double width = 2;
    const double amplitude = 1.05 * kStrength / std::pow(sigma, 1.5) *
                             std::pow(width * width + 1.0 / 12 + sigma * sigma, 1.5) / width;
    add_stripe(light, -50, 300, kWidth + 50, 420, amplitude, width);
    comparison.add("just above threshold", expose(light, 0), sigma, kStrength);
    comparison.add("the same with noise", expose(light, 1), sigma, kStrength);
  }
  json["identity.max_deviation_px"] = comparison.total().largest_deviation;
  json["identity.missing"] = comparison.total().missing;
  json["identity.extra"] = comparison.total().extra;
  json["identity.points"] = comparison.total().judged;
  fmt::print("{:<24} {:>5} {:9} {:8} {:8} {:12.7f}\n", "all", "", comparison.total().judged,
             comparison.total().missing, comparison.total().extra,
             comparison.total().largest_deviation);
}

}  // namespace arcstart
