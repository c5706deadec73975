// By how much centres scatter about a smooth stripe, told from their branches alone.
#pragma once

#include <vector>

#include "services/extraction/image/frame_arena.hpp"
#include "services/extraction/lines/stripe_path.hpp"

namespace arcstart::extraction {

// The centre of a point, which may have been measured at another sigma than it was found at.
struct MeasuredCentre {
  float u, v;       // px
  float deviation;  // by the law of white noise; px
  float sigma;      // px
};

// A centre's variance: base + per_law x that of white noise.
struct CentreNoise {
  double base = 0;  // px^2
  double per_law = 1;
  double variance = 0;  // of the middle one of all; px^2
};

// The law knows white noise alone; the surface's grain scatters the centres more, the fainter the
// stripe, and speckle does whatever its strength. By how much: from fourth differences of centres
// two sigma apart, in which the surface's own bends all but vanish; errors of centres so far apart
// hang together by exp(-d^2 / (4 sigma^2)). Those of the stronger half and of the fainter half of
// the centres tell both parts.
// centres: of each point that the branches name. The law alone where too few are chosen.
CentreNoise centre_noise(const std::vector<Branch>& branches,
                         const std::vector<MeasuredCentre>& centres, double sigma, Memory memory);

}  // namespace arcstart::extraction
