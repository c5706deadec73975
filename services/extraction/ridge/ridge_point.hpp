// Steger's ridge point: where the grey values across a bright line have their maximum.
#pragma once

#include <cstdint>

namespace arcstart::extraction {

struct RidgePoint {
  float u, v;                // px, pixel centres at integers
  float normal_u, normal_v;  // unit, across the line, of either sense
  float curvature;  // size of the second derivative across the line, > 0; grey values / px^2
  std::int32_t column, row;  // the pixel that holds it: |u - column| <= 1/2, |v - row| <= 1/2
};

}  // namespace arcstart::extraction
