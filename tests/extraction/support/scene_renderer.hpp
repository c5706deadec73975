// Images of a laser stripe with exact truth, from closed forms: nothing of the extraction is used.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace arcstart::extraction {

enum class StripeSceneKind { kClean, kTypical, kGlare, kSaturated, kLowContrast };
constexpr StripeSceneKind kAllStripeScenes[] = {
    StripeSceneKind::kClean, StripeSceneKind::kTypical, StripeSceneKind::kGlare,
    StripeSceneKind::kSaturated, StripeSceneKind::kLowContrast};
const char* name_of(StripeSceneKind kind);

// What a scene is made of.
struct StripeSceneSettings {
  int width = 1600, height = 1200;  // px
  double amplitude = 150;           // of the stripe; grey values
  double stripe_width = 2.5;        // standard deviation of its profile; px
  bool modulated = false;   // amplitude x 1 +- 0.35 +- 0.15, width +- 0.9 px along the stripe
  double speckle = 0;       // contrast; grain of about 3.3 px
  double read_noise = 1.5;  // grey values
  double electrons_per_grey = 39;  // of which shot noise follows; 0: none
  int gaps = 0;                    // of 16 to 66 px
  bool surroundings = false;       // halo, texture, a gradient of 12 grey values, 60 scratches:
  double halo = 0.35;              // share of the stripe's light, blurred with sigma 12 px
  double texture = 2;              // standard deviation, of a grain of sigma 3 px; grey values
  bool scratches = true;           // of 4 to 12 grey values
  int blobs = 0;                   // of sigma 3 to 15 by 3 to 11 px, 60 to 260 grey values
  bool ghost = false;  // 45 to 95 px beside the stripe, 150 to 300 px long, 0.35 of its brightness
  bool arc = false;    // glare with rays, and spatter
};
StripeSceneSettings stripe_scene_settings(StripeSceneKind kind);

// The stripe's middle (the peak of its noiseless profile), every half pixel of its length.
struct TruthPoint {
  double u, v;    // px
  bool visible;   // not in a gap
  double corner;  // distance along u to the nearest corner; px
};

struct StripeScene {
  cv::Mat grey;  // 8 bit
  std::vector<TruthPoint> truth;
};
StripeScene render_stripe_scene(const StripeSceneSettings& settings, std::uint64_t seed);

}  // namespace arcstart::extraction
