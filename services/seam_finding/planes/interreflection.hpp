// Strips of a plate along a seam, and which of them tell its plane.
#pragma once

#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>

namespace arcstart::seam_finding {

constexpr std::size_t kStrips = 16;

// The stripe's reflection from the other plate shifts its centre by a tenth of a millimetre over
// wide strips of a plate: far less than single points scatter, so that only their means tell.
struct Strip {
  double distance = 0, height = 0, points = 0;  // means, from the seam and over a plane; mm
};
using StripMeans = std::array<Strip, kStrips>;  // from the seam outward

// What a reflection adds to the heights. At the seam it lies on the stripe; from there it moves
// aside in proportion to the distance, draws the stripe's centre along, and lets go of it once it
// lies beside the stripe.
struct InterreflectionShift {
  double most = 0, at = 1;  // mm, at that distance from the seam
  double operator()(double distance) const {
    const double r = distance / at;
    return most * r * std::exp((1 - r * r) / 2);
  }
};

// Those that lie on one line, seen along the seam, once the heights are lowered by the shift. All
// where no line is plain.
struct ConsistentStrips {
  std::bitset<kStrips> strips;
  InterreflectionShift shift;
};

// noise: standard deviation of a single point's height; mm.
ConsistentStrips consistent_strips(const StripMeans& strips, double noise);

}  // namespace arcstart::seam_finding
