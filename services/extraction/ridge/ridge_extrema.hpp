// Steger's test of a pixel, for many at once.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "services/extraction/image/simd_vectors.hpp"

namespace arcstart::extraction {

// Pixels that are bent enough, side by side wherever they lie: few of an image's are, and so the
// test is for registers full of them. Derivatives of the smoothed grey values.
template <int kFloats>
struct BentPixels {
  static constexpr int kMost = 5 * kFloats;  // of four registers, and what was left before
  static constexpr int kRoom = kMost + kFloats;
  alignas(64) float u[kRoom], v[kRoom], uu[kRoom], uv[kRoom], vv[kRoom];
  alignas(64) float column[kRoom]{}, row[kRoom]{};  // whole numbers also where no pixel is yet
  int count = 0;
};

// What a register's pixels say.
template <int kFloats>
struct Extrema {
  float u[kFloats], v[kFloats];    // of the extremum across the line; px
  float nu[kFloats], nv[kFloats];  // across the line, unit
  float curvature[kFloats];
  std::int32_t column[kFloats], row[kFloats], is_ridge[kFloats];  // the last -1 or 0
};

// Adds those that bits name of a row's, the first of which is in that column.
template <int kFloats>
ARCSTART_INLINE_BODY void add_pixels(std::uint32_t bits, Lanes<kFloats> u, Lanes<kFloats> v,
                                     Lanes<kFloats> uu, Lanes<kFloats> uv, Lanes<kFloats> vv,
                                     int column, int row, BentPixels<kFloats>& pixels) {
  store_named<kFloats>(pixels.u + pixels.count, u, bits);
  store_named<kFloats>(pixels.v + pixels.count, v, bits);
  store_named<kFloats>(pixels.uu + pixels.count, uu, bits);
  store_named<kFloats>(pixels.uv + pixels.count, uv, bits);
  store_named<kFloats>(pixels.vv + pixels.count, vv, bits);
  Lanes<kFloats> columns;
  for (int i = 0; i < kFloats; ++i) columns[i] = static_cast<float>(i);
  store_named<kFloats>(pixels.column + pixels.count, columns + static_cast<float>(column), bits);
  store(pixels.row + pixels.count, Lanes<kFloats>{} + static_cast<float>(row));
  pixels.count += std::popcount(bits);
}

// Puts the last register, perhaps not full, to the front. begin: where it is.
template <int kFloats>
ARCSTART_INLINE_BODY void keep_from(int begin, BentPixels<kFloats>& pixels) {
  for (float* values :
       {pixels.u, pixels.v, pixels.uu, pixels.uv, pixels.vv, pixels.column, pixels.row})
    store(values, load<kFloats>(values + begin));
  pixels.count = std::max(0, pixels.count - begin);
}

// Of the pixels from begin on. The eigenvalue of largest absolute value must be the negative one; t
// is the extremum's distance along its eigenvector n (Steger 1998, Eq. 22), farthest the most that
// it may be in u and in v.
template <int kFloats>
ARCSTART_INLINE_BODY void find_extrema(float least_curvature, float farthest,
                                       const BentPixels<kFloats>& pixels, int begin,
                                       Extrema<kFloats>& e) {
  const float *u = pixels.u + begin, *v = pixels.v + begin;
  const float *uu = pixels.uu + begin, *uv = pixels.uv + begin, *vv = pixels.vv + begin;
  for (int i = 0; i < kFloats; ++i) {
    const float half_trace = 0.5f * (uu[i] + vv[i]), half_difference = 0.5f * (uu[i] - vv[i]);
    const float root = std::sqrt(half_difference * half_difference + uv[i] * uv[i]);
    const float eigenvalue = half_trace - root;
    // (uu - eigenvalue, uv) or (uv, vv - eigenvalue), crossed: the longer for its accuracy.
    const bool down = half_difference <= 0;
    const float longer = root + std::abs(half_difference);
    float nu = down ? longer : -uv[i];
    float nv = down ? -uv[i] : longer;
    // Curved alike in all directions: any normal will do.
    nv = longer > 0 ? nv : 1;
    const float square = nu * nu + nv * nv, scale = 1 / std::sqrt(square);
    const float t = -(u[i] * nu + v[i] * nv) / (eigenvalue * square);
    const float du = t * nu, dv = t * nv;
    const float off_u = std::abs(du), off_v = std::abs(dv);
    const bool is_ridge = (half_trace <= 0) & (eigenvalue <= -least_curvature) &
                          (off_u <= farthest) & (off_v <= farthest);
    e.column[i] = static_cast<std::int32_t>(pixels.column[begin + i]);
    e.row[i] = static_cast<std::int32_t>(pixels.row[begin + i]);
    e.u[i] = pixels.column[begin + i] + du;
    e.v[i] = pixels.row[begin + i] + dv;
    e.nu[i] = nu * scale;
    e.nv[i] = nv * scale;
    e.curvature[i] = -eigenvalue;
    e.is_ridge[i] = -static_cast<std::int32_t>(is_ridge);
  }
}

}  // namespace arcstart::extraction
