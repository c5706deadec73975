#include <fmt/core.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "services/extraction/image/laser_light.hpp"
#include "services/extraction/stripe_extractor.hpp"
#include "tests/bench/extraction/extraction_bench.hpp"
#include "tests/extraction/support/scene_score.hpp"
#include "tests/extraction/support/steel_scene.hpp"
#include "tests/extraction/support/steel_surface.hpp"
#include "tests/extraction/support/stripe_image.hpp"

namespace arcstart {

using namespace extraction;
namespace {

// The course is the stripe and nothing else: no chosen centre farther than 3 px from it, and nine
// tenths of what shows of it found.
constexpr double kLeastRecall = 0.9;
// The course is wrong: over so much of its length.
constexpr double kWrongShare = 0.05;

struct SteelTotals {
  StripeSceneScore score;
  double claimed_squares = 0;  // px^2, of the centres that have an error
  int images = 0, right = 0, silently_wrong = 0, empty = 0;
};

void add(const SteelScene& scene, const Stripe& stripe, SteelTotals& totals, std::string& remark) {
  std::vector<Centre> centres;
  StripeSceneScore one;
  for (const StripeCentre& c : stripe.centres) {
    if (!c.chosen) continue;
    const Centre centre = scene.turned ? Centre{c.v, c.u} : Centre{c.u, c.v};
    const StripeSceneScore alone = score(scene.lit, {centre});
    if (alone.wrong == 0) totals.claimed_squares += c.deviation * c.deviation;
    centres.push_back(centre);
  }
  one = score(scene.lit, centres);
  totals.score.add(one);
  ++totals.images;
  totals.right += one.wrong == 0 && one.recall() >= kLeastRecall;
  totals.empty += centres.empty();
  totals.silently_wrong += one.false_share() > kWrongShare;
  remark = fmt::format("recall {:5.1f} %, false {:5.1f} %, rms {:.3f} px, sigma {:.2f}",
                       100 * one.recall(), 100 * one.false_share(), one.rms(), stripe.sigma);
}

}  // namespace

void bench_steel(SteelSceneKind kind, int first_seed, int seeds, nlohmann::json& json) {
  fmt::print(
      "\nReal steel, {}: as the service runs it, each image by itself; difference: less the image "
      "with the laser off\n",
      name_of(kind));
  // The print is what an image with the laser off shows as well.
  for (const bool difference : {false, true}) {
    if (difference && kind != SteelSceneKind::kPrint) continue;
    const std::string row = std::string(name_of(kind)) + (difference ? "_difference" : "");
    SteelTotals totals;
    for (int seed = first_seed; seed < first_seed + seeds; ++seed) {
      const SteelScene scene = render_steel_scene(kind, static_cast<std::uint64_t>(seed));
      std::vector<std::uint8_t> light;
      const GreyImage grey = difference
                                 ? laser_light(view_of(scene.lit.grey), view_of(scene.unlit), light)
                                 : view_of(scene.lit.grey);
      std::string remark;
      StripeExtractor extractor{ExtractionSettings{}};
      add(scene, extractor.extract(grey), totals, remark);
      fmt::print("  {} seed {}: {}\n", row, seed, remark);
      std::fflush(stdout);
    }
    const double rms = totals.score.rms(),
                 claimed =
                     std::sqrt(totals.claimed_squares / static_cast<double>(std::max<std::size_t>(
                                                            1, totals.score.errors.size()))),
                 images = totals.images;
    fmt::print(
        "{:<20} images {}: the stripe and nothing else in {} ({:.0f} %), silently wrong over 5 % "
        "{}, empty {}; rms {:.3f} px, recall {:.2f} %, false {:.2f} %, claimed / true {:.2f}\n",
        row, totals.images, totals.right, 100 * totals.right / images, totals.silently_wrong,
        totals.empty, rms, 100 * totals.score.recall(), 100 * totals.score.false_share(),
        rms > 0 ? claimed / rms : 0);
    json[row + ".right"] = totals.right / images;
    json[row + ".silently_wrong"] = totals.silently_wrong;
    json[row + ".empty"] = totals.empty;
    json[row + ".rms_px"] = rms;
    json[row + ".recall"] = totals.score.recall();
    json[row + ".false"] = totals.score.false_share();
    json[row + ".claimed_over_true"] = rms > 0 ? claimed / rms : 0;
  }
}

}  // namespace arcstart
