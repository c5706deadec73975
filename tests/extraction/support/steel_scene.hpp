// Images of a stripe on surfaces as real steel has them, with exact truth.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "tests/extraction/support/scene_renderer.hpp"

namespace arcstart::extraction {

enum class SteelSceneKind {
  kTexture,    // each surface of steel_surface.hpp in turn, its lay at any angle
  kNeighbour,  // a glossy plate throws a second stripe, 1.8 to 3 times as broad, 0.3 to 0.8 as high
  kPrint,      // a chessboard lies under the stripe
  kMixedWidth,  // the stripe is 1 to 8 px wide (sigma) within the image
};
constexpr SteelSceneKind kAllSteelScenes[] = {SteelSceneKind::kTexture, SteelSceneKind::kNeighbour,
                                              SteelSceneKind::kPrint, SteelSceneKind::kMixedWidth};
const char* name_of(SteelSceneKind kind);

// 1600 x 1200 px, every second one (by the seed) turned to 1200 x 1600 with the stripe running
// down. Truth is the peak of the laser's light before the surface throws it back, in the image
// before it is turned: in a turned one u and v change places.
struct SteelScene {
  StripeScene lit;
  cv::Mat unlit;  // the same with the laser off
  bool turned;
};
SteelScene render_steel_scene(SteelSceneKind kind, std::uint64_t seed);

}  // namespace arcstart::extraction
