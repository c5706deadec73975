// Sums for a least-squares plane in which a point counts the less the farther off it lies.
#pragma once

#include <cstddef>

namespace arcstart::seam_finding {

// Points as heights h at places (a, b) of a plane, mm, side by side in whole registers.
struct PlacedHeights {
  const float *a, *b, *h;
  std::size_t count;  // a multiple of 16
};
// So many points fill whole registers, of any instruction set.
constexpr std::size_t whole_registers(std::size_t points) { return (points + 15) / 16 * 16; }

// Over the points, each with Tukey's weight w; r: its distance in h from the plane.
struct BiweightSums {
  double w = 0, a = 0, b = 0, aa = 0, ab = 0, bb = 0, r = 0, ra = 0, rb = 0;
};

// About the plane h = offset + along * a + across * b. A point farther from it than the limit, mm,
// does not count. In floats: good to a millionth.
BiweightSums biweight_sums(const PlacedHeights& points, double offset, double along, double across,
                           double limit);

}  // namespace arcstart::seam_finding
