// A small picture for people, in which a thin bright stripe stays.
#pragma once

#include <cstdint>
#include <vector>

namespace arcstart::sensor_capture {

struct Preview {
  int width = 0, height = 0;         // px
  std::vector<std::uint8_t> pixels;  // row by row
};

// Each pixel is the largest of a square block, the smallest blocks with which no more than
// most_pixels come out.
Preview reduce_by_maximum(const std::vector<std::uint8_t>& pixels, int width, int height,
                          int most_pixels);

}  // namespace arcstart::sensor_capture
