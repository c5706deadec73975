// Where the light of a stripe ends on its middle line.
#pragma once

#include <optional>

#include "services/extraction/image/grey_image.hpp"

namespace arcstart::extraction {

// From a point of the stripe on, in the direction it has there.
struct StripeRay {
  double u, v;    // px
  double du, dv;  // unit, outwards
};

struct RayEdge {
  double at = 0;   // px along the ray
  int fading = 0;  // px over which the light goes from three quarters to one
};

// The light along the ray, from its beginning: how much the grey values bend across it, which no
// even background changes. Where it is half as bright as before, and gone soon after; nothing where
// that cannot be told, or lies farther than six widths away. width: standard deviation of the
// stripe's profile, kLargestWidth at most. length_before: of the stripe; px.
constexpr double kLeastWidth = 0.8, kLargestWidth = 12;  // px
std::optional<RayEdge> ray_edge(const GreyImage& image, const StripeRay& ray, double width,
                                int length_before);

}  // namespace arcstart::extraction
