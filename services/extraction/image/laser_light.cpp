#include "services/extraction/image/laser_light.hpp"

namespace arcstart::extraction {
namespace {

// Grey values that the laser adds at least where a clipped pixel is its doing; below, noise and
// compression of two images near white differ as much. A stripe that adds less is not seen anyway.
constexpr int kByLaser = 24;

}  // namespace

GreyImage laser_light(const GreyImage& lit, const GreyImage& unlit,
                      std::vector<std::uint8_t>& out) {
  out.resize(static_cast<std::size_t>(lit.width) * static_cast<std::size_t>(lit.height));
  for (int v = 0; v < lit.height; ++v) {
    const std::uint8_t *on = lit.row(v), *off = unlit.row(v);
    std::uint8_t* light = out.data() + static_cast<std::ptrdiff_t>(v) * lit.width;
    for (int u = 0; u < lit.width; ++u) {
      const int difference = on[u] > off[u] ? on[u] - off[u] : 0;
      light[u] =
          static_cast<std::uint8_t>(on[u] == 255 && difference >= kByLaser ? 255 : difference);
    }
  }
  return {out.data(), lit.width, lit.height, lit.width};
}

}  // namespace arcstart::extraction
