#include "services/sensor_capture/frames/preview.hpp"

#include <algorithm>

namespace arcstart::sensor_capture {

Preview reduce_by_maximum(const std::vector<std::uint8_t>& pixels, int width, int height,
                          int most_pixels) {
  int block = 1;
  const auto blocks = [&](int length) { return (length + block - 1) / block; };
  while (blocks(width) * blocks(height) > most_pixels) ++block;

  Preview preview{blocks(width), blocks(height), {}};
  preview.pixels.resize(static_cast<std::size_t>(preview.width) *
                        static_cast<std::size_t>(preview.height));
  auto pixel = pixels.begin();
  for (int v = 0; v < height; ++v) {
    const auto row =
        preview.pixels.begin() + static_cast<std::ptrdiff_t>(v / block) * preview.width;
    for (int u = 0; u < width; ++u, ++pixel) {
      std::uint8_t& largest = row[u / block];
      largest = std::max(largest, *pixel);
    }
  }
  return preview;
}

}  // namespace arcstart::sensor_capture
