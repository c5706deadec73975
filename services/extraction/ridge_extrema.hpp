// Steger's test of a pixel, for many at once.
#pragma once

#include <cmath>
#include <cstdint>

#include "services/extraction/instruction_sets.hpp"

namespace arcstart {

// Of some pixels: derivatives of the smoothed grey values, and what they say.
template <int kPixels>
struct Extrema {
  float u[kPixels], v[kPixels], uu[kPixels], uv[kPixels], vv[kPixels];
  float du[kPixels], dv[kPixels];  // from the pixel's centre to the extremum across the line; px
  float nu[kPixels], nv[kPixels];  // across the line, unit
  float curvature[kPixels];
  std::uint8_t is_ridge[kPixels];
};

// The eigenvalue of largest absolute value must be the negative one; t is the extremum's distance
// along its eigenvector n (Steger 1998, Eq. 22).
template <int kPixels>
ARCSTART_INLINE_BODY void find_extrema(float least_curvature, Extrema<kPixels>& e) {
  std::int32_t is_ridge[kPixels];
  for (int i = 0; i < kPixels; ++i) {
    const float half_trace = 0.5f * (e.uu[i] + e.vv[i]),
                half_difference = 0.5f * (e.uu[i] - e.vv[i]);
    const float root = std::sqrt(half_difference * half_difference + e.uv[i] * e.uv[i]);
    const float eigenvalue = half_trace - root;
    // (uu - eigenvalue, uv) or (uv, vv - eigenvalue), crossed: the longer for its accuracy.
    const bool down = half_difference <= 0;
    const float longer = root + std::abs(half_difference);
    float nu = down ? longer : -e.uv[i];
    float nv = down ? -e.uv[i] : longer;
    // Curved alike in all directions: any normal will do.
    nv = longer > 0 ? nv : 1;
    const float square = nu * nu + nv * nv, scale = 1 / std::sqrt(square);
    const float t = -(e.u[i] * nu + e.v[i] * nv) / (eigenvalue * square);
    const float du = t * nu, dv = t * nv;
    is_ridge[i] = (half_trace <= 0) & (eigenvalue <= -least_curvature) & (std::abs(du) <= 0.5f) &
                  (std::abs(dv) <= 0.5f);
    e.du[i] = du;
    e.dv[i] = dv;
    e.nu[i] = nu * scale;
    e.nv[i] = nv * scale;
    e.curvature[i] = -eigenvalue;
  }
  for (int i = 0; i < kPixels; ++i) e.is_ridge[i] = static_cast<std::uint8_t>(is_ridge[i]);
}

}  // namespace arcstart
