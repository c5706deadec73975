#include <fmt/core.h>

#include <cmath>
#include <map>
#include <vector>

#include "services/extraction/stripe_extractor.hpp"
#include "tests/bench/extraction/extraction_bench.hpp"
#include "tests/extraction/support/column_methods.hpp"
#include "tests/extraction/support/plain_ridge.hpp"
#include "tests/extraction/support/scene_score.hpp"
#include "tests/extraction/support/stripe_image.hpp"

namespace arcstart {

using namespace extraction;
namespace {

std::vector<Centre> chosen_centres(const extraction::Stripe& stripe) {
  std::vector<Centre> centres;
  for (const extraction::StripeCentre& c : stripe.centres)
    if (c.chosen) centres.push_back({c.u, c.v});
  return centres;
}

void print(const std::string& what, const StripeSceneScore& score) {
  fmt::print("{:<44} {:8.4f} {:8.4f} {:8.2f} {:8.2f} {:8}\n", what, score.rms(), score.p95(),
             100 * score.recall(), 100 * score.false_share(), score.centres);
  std::fflush(stdout);
}

void record(const std::string& row, const StripeSceneScore& score, nlohmann::json& json) {
  json[row + ".rms_px"] = score.rms();
  json[row + ".p95_px"] = score.p95();
  json[row + ".recall"] = score.recall();
  json[row + ".false"] = score.false_share();
}

// The least a ridge must have for the plain form: what starts a segment in the extractor.
double least_curvature(double sigma) {
  const extraction::ExtractionSettings settings;
  return settings.least_strength / extraction::strength_factor(sigma, settings.strength_exponent);
}

void print_head(const std::string& title) {
  fmt::print("\n{}\n{:<44} {:>8} {:>8} {:>8} {:>8} {:>8}\n", title, "", "rms px", "95 % px",
             "recall %", "false %", "centres");
}

// The law for noise that grows with the light: its variance at the slopes of the profile, where the
// first derivative's kernel weighs most, is that of a light exp(-1/2) as high as the top.
double law(const StripeSceneSettings& scene, double sigma) {
  double variance = scene.read_noise * scene.read_noise + 1.0 / 12;
  if (scene.electrons_per_grey > 0)
    variance += (10 + scene.amplitude * std::exp(-0.5 * std::pow(sigma / scene.stripe_width, 2))) /
                scene.electrons_per_grey;
  const double w = std::hypot(scene.stripe_width, std::sqrt(1.0 / 12));
  return 0.1995 * std::sqrt(variance) * std::pow(w * w + sigma * sigma, 1.5) /
         (scene.amplitude * w * sigma * sigma);
}

}  // namespace

void bench_accuracy(int seeds, nlohmann::json& json) {
  print_head(
      "Accuracy. Truth: the peak of the noiseless profile. arcstart as the service runs it; "
      "opencv: "
      "the plain ridge\npoints at the same sigma, unselected. clean: parts 5 sigma and more from "
      "a corner.");
  for (const StripeSceneKind kind : kAllStripeScenes) {
    const std::string name = name_of(kind);
    const StripeSceneSettings settings = stripe_scene_settings(kind);
    std::map<std::string, StripeSceneScore> totals;
    double law_sum = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const StripeScene scene = render_stripe_scene(settings, static_cast<std::uint64_t>(seed));
      const extraction::Stripe stripe =
          extraction::StripeExtractor(extraction::ExtractionSettings{})
              .extract(view_of(scene.grey));
      const double sigma = stripe.sigma,
                   from_corners = kind == StripeSceneKind::kClean ? 5 * sigma : 0;
      law_sum += law(settings, sigma);
      const auto add = [&](const std::string& row, const std::vector<Centre>& centres) {
        const StripeSceneScore one = score(scene, centres, from_corners);
        totals[row].add(one);
        return one;
      };
      const StripeSceneScore ours = add("", chosen_centres(stripe));
      print(fmt::format("{} seed {} (sigma {:.2f})", name, seed, sigma), ours);
      record(fmt::format("{}.seed_{}", name, seed), ours, json);
      std::vector<extraction::RidgePoint> points;
      PlainRidgeDetector().detect(scene.grey, extraction::gaussian_kernels(sigma),
                                  least_curvature(sigma), points);
      std::vector<Centre> centres;
      for (const extraction::RidgePoint& p : points) centres.push_back({p.u, p.v});
      add("opencv.", centres);
      ColumnMethods columns;
      columns.centroid(scene.grey, sigma, centres);
      add("centroid.", centres);
      columns.gaussian_fit(scene.grey, sigma, centres);
      add("gaussian_fit.", centres);
      columns.finite_impulse(scene.grey, sigma, centres);
      add("fir.", centres);
    }
    for (const auto& [row, total] : totals) {
      print((row.empty() ? "arcstart." : row) + name, total);
      record(row + name, total, json);
    }
    if (kind == StripeSceneKind::kClean) {
      json["clean.law_px"] = law_sum / seeds;
      fmt::print("{:<44} {:8.4f}  (1.15 x law + 0.003: {:.4f})\n", "law of noise", law_sum / seeds,
                 1.15 * law_sum / seeds + 0.003);
    }
  }
}

void bench_disturbances(int seeds, nlohmann::json& json) {
  struct Without {
    const char* what;
    void (*change)(StripeSceneSettings&);
  };
  const Without without[] = {
      {"nothing", [](StripeSceneSettings&) {}},
      {"read_noise", [](StripeSceneSettings& s) { s.read_noise = 0; }},
      {"shot_noise", [](StripeSceneSettings& s) { s.electrons_per_grey = 0; }},
      {"speckle", [](StripeSceneSettings& s) { s.speckle = 0; }},
      {"texture", [](StripeSceneSettings& s) { s.texture = 0; }},
      {"scratches", [](StripeSceneSettings& s) { s.scratches = false; }},
      {"halo", [](StripeSceneSettings& s) { s.halo = 0; }}};
  print_head("Low contrast without one of its disturbances, the same seeds");
  for (const double sigma : {0.0, 2.5, 3.5, 5.0})
    for (const Without& one : without) {
      StripeSceneSettings settings = stripe_scene_settings(StripeSceneKind::kLowContrast);
      one.change(settings);
      extraction::ExtractionSettings extraction;
      extraction.sigma_px = sigma;
      StripeSceneScore total;
      for (int seed = 1; seed <= seeds; ++seed) {
        const StripeScene scene = render_stripe_scene(settings, static_cast<std::uint64_t>(seed));
        total.add(score(
            scene,
            chosen_centres(extraction::StripeExtractor(extraction).extract(view_of(scene.grey)))));
      }
      const std::string row =
          fmt::format("low_contrast.sigma_{}.without_{}",
                      sigma == 0 ? "followed" : fmt::format("{}", sigma), one.what);
      print(row, total);
      record(row, total, json);
    }
}

void bench_white_noise(int seeds, nlohmann::json& json) {
  print_head("White noise alone, width 2.5, A 150, parts 5 sigma and more from a corner");
  for (const double sigma : {2.5, 3.5})
    for (const int ratio : {75, 46, 27, 19, 10, 5}) {
      StripeSceneSettings settings = stripe_scene_settings(StripeSceneKind::kClean);
      settings.electrons_per_grey = 0;
      settings.read_noise = settings.amplitude / ratio;
      StripeSceneScore total;
      for (int seed = 1; seed <= seeds; ++seed) {
        const StripeScene scene = render_stripe_scene(settings, static_cast<std::uint64_t>(seed));
        extraction::ExtractionSettings fixed;
        fixed.sigma_px = sigma;
        total.add(score(
            scene, chosen_centres(extraction::StripeExtractor(fixed).extract(view_of(scene.grey))),
            5 * sigma));
      }
      const double expected = law(settings, sigma);
      const std::string row = fmt::format("white_noise.sigma_{}_ratio_{}", sigma, ratio);
      print(row, total);
      fmt::print("{:<44} {:8.4f}  (1.15 x law + 0.003: {:.4f})\n", "  law", expected,
                 1.15 * expected + 0.003);
      record(row, total, json);
      json[row + ".law_px"] = expected;
    }
}

}  // namespace arcstart
