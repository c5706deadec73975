// What the laser alone lights: an image with it on less one with it off.
#pragma once

#include <vector>

#include "services/extraction/image/grey_image.hpp"

namespace arcstart::extraction {

// lit - unlit, not below 0; 255 (white) where lit is clipped and the laser adds to it. There the
// difference is that of the clipped top, as high as the surroundings leave room for, and would pass
// for a stripe's own: clipping is known from the lit image alone. A place that the lamp clips by
// itself stays dark. Both of one size; out: the memory of the image returned, row by row.
GreyImage laser_light(const GreyImage& lit, const GreyImage& unlit, std::vector<std::uint8_t>& out);

}  // namespace arcstart::extraction
