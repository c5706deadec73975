#include "services/extraction/ridge_tile.hpp"

#include <cmath>
#include <cstring>

#include "services/extraction/instruction_sets.hpp"

namespace arcstart {
namespace {

// Eight columns at once. Where the processor has narrower registers, the compiler splits them.
typedef float Lanes __attribute__((vector_size(32)));
constexpr int kLanes = 8;
constexpr int kChunk = 2 * kLanes;
static_assert(kTileWidth % kChunk == 0);

ARCSTART_INLINE_BODY Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
ARCSTART_INLINE_BODY void store(float* to, Lanes lanes) { std::memcpy(to, &lanes, sizeof lanes); }

// Smoothed grey value's derivatives at one pixel.
struct Derivatives {
  float u, v, uu, uv, vv;
};

// The pixel's ridge point, if it has one. The eigenvalue of largest absolute value must be the
// negative one; t is the extremum's distance along its eigenvector n (Steger 1998, Eq. 22).
void add_ridge_point(const Derivatives& d, float least_curvature, int column, int row,
                     std::vector<RidgePoint>& points) {
  const float half_trace = 0.5f * (d.uu + d.vv), half_difference = 0.5f * (d.uu - d.vv);
  if (half_trace > 0) return;
  const float root = std::sqrt(half_difference * half_difference + d.uv * d.uv);
  const float eigenvalue = half_trace - root;
  if (eigenvalue > -least_curvature) return;
  // (uu - eigenvalue, uv) or (uv, vv - eigenvalue), crossed: take the longer for its accuracy.
  float nu, nv;
  if (half_difference <= 0) {
    nu = root - half_difference;
    nv = -d.uv;
  } else {
    nu = -d.uv;
    nv = root + half_difference;
  }
  const float length = std::sqrt(nu * nu + nv * nv);
  if (!(length > 0)) {  // curved alike in all directions: any normal will do
    nu = 0;
    nv = 1;
  } else {
    nu /= length;
    nv /= length;
  }
  const float t = -(d.u * nu + d.v * nv) / eigenvalue;
  const float du = t * nu, dv = t * nv;
  if (!(std::abs(du) <= 0.5f && std::abs(dv) <= 0.5f)) return;
  points.push_back({static_cast<float>(column) + du, static_cast<float>(row) + dv, nu, nv,
                    -eigenvalue, column, row});
}

// The rows of grey values in reach of an output row, filtered by smooth, first and second. A ring
// of 2 half_width + 1 rows, each kept twice, so that the rows in reach always lie one after the
// other.
struct Ring {
  int rows;
  float* smooth;
  float* first;
  float* second;
};

ARCSTART_INLINE_BODY void filter_row(const RidgeTile& tile, const float* line, int slot,
                                     const Ring& ring) {
  for (int u = 0; u < kTileWidth; u += kChunk) {
    const float* centre = line + tile.half_width + u;
    Lanes smooth[2], first[2], second[2];
    for (int c = 0; c < 2; ++c) {
      const Lanes grey = load(centre + c * kLanes);
      smooth[c] = grey * tile.smooth[0];
      second[c] = grey * tile.second[0];
      first[c] = grey - grey;
    }
    for (int k = 1; k <= tile.half_width; ++k) {
      const float g0 = tile.smooth[k], g1 = tile.first[k], g2 = tile.second[k];
      for (int c = 0; c < 2; ++c) {
        const Lanes right = load(centre + c * kLanes + k), left = load(centre + c * kLanes - k);
        const Lanes sum = right + left;
        smooth[c] += sum * g0;
        first[c] += (right - left) * g1;
        second[c] += sum * g2;
      }
    }
    for (const int row : {slot, slot + ring.rows})
      for (int c = 0; c < 2; ++c) {
        const int at = row * kTileWidth + u + c * kLanes;
        store(ring.smooth + at, smooth[c]);
        store(ring.first + at, first[c]);
        store(ring.second + at, second[c]);
      }
  }
}

// Bit i set where lane i's smaller eigenvalue is -limit or less: the determinant of (Hessian +
// limit) is negative, or its trace is. No square root.
ARCSTART_INLINE_BODY unsigned strong_lanes(Lanes uu, Lanes uv, Lanes vv, float limit) {
  const Lanes determinant = (uu + limit) * (vv + limit) - uv * uv;
  const Lanes trace = uu + vv + 2 * limit;
  const auto strong = (determinant <= 0.0f) | (trace < 0.0f);
  std::int32_t lane[kLanes];
  std::memcpy(lane, &strong, sizeof lane);
  unsigned bits = 0;
  for (int i = 0; i < kLanes; ++i) bits |= (lane[i] != 0 ? 1u : 0u) << i;
  return bits;
}

// One output row: the ring's rows from window on are those in reach.
ARCSTART_INLINE_BODY void filter_column(const RidgeTile& tile, const Ring& ring, int window,
                                        int row, std::vector<RidgePoint>& points) {
  const int half_width = tile.half_width;
  for (int u = 0; u < kTileWidth; u += kLanes) {
    const int at = (window + half_width) * kTileWidth + u;
    const float *p0 = ring.smooth + at, *p1 = ring.first + at, *p2 = ring.second + at;
    Lanes uu = load(p2) * tile.smooth[0], vv = load(p0) * tile.second[0], uv = vv - vv;
    for (int k = 1; k <= half_width; ++k) {
      const int step = k * kTileWidth;
      uu += (load(p2 + step) + load(p2 - step)) * tile.smooth[k];
      uv += (load(p1 + step) - load(p1 - step)) * tile.first[k];
      vv += (load(p0 + step) + load(p0 - step)) * tile.second[k];
    }
    unsigned bits = strong_lanes(uu, uv, vv, tile.least_curvature);
    if (bits == 0) continue;
    Lanes du = load(p1) * tile.smooth[0], dv = du - du;
    for (int k = 1; k <= half_width; ++k) {
      const int step = k * kTileWidth;
      du += (load(p1 + step) + load(p1 - step)) * tile.smooth[k];
      dv += (load(p0 + step) - load(p0 - step)) * tile.first[k];
    }
    float at_lane[5][kLanes];
    store(at_lane[0], du);
    store(at_lane[1], dv);
    store(at_lane[2], uu);
    store(at_lane[3], uv);
    store(at_lane[4], vv);
    for (int i = 0; bits != 0; ++i, bits >>= 1) {
      const int column = tile.column + u + i;
      if ((bits & 1u) == 0 || column < tile.first_column || column > tile.last_column) continue;
      add_ridge_point({at_lane[0][i], at_lane[1][i], at_lane[2][i], at_lane[3][i], at_lane[4][i]},
                      tile.least_curvature, column, row, points);
    }
  }
}

ARCSTART_INLINE_BODY void find_ridge_points_in_body(const RidgeTile& tile,
                                                    std::vector<RidgePoint>& points) {
  const int half_width = tile.half_width, ring_rows = 2 * half_width + 1;
  const int plane = 2 * ring_rows * kTileWidth;
  const Ring ring{ring_rows, tile.work, tile.work + plane, tile.work + 2 * plane};
  float* line = tile.work + 3 * plane;
  const GreyImage& image = tile.image;
  const int line_size = kTileWidth + 2 * half_width, begin = tile.column - half_width;
  const bool inside = begin >= 0 && begin + line_size <= image.width;

  for (int i = 0; i < tile.rows + 2 * half_width; ++i) {
    const std::uint8_t* greys = image.row(reflect_101(tile.row + i - half_width, image.height));
    if (inside)
      for (int k = 0; k < line_size; ++k) line[k] = greys[begin + k];
    else
      for (int k = 0; k < line_size; ++k) line[k] = greys[reflect_101(begin + k, image.width)];
    filter_row(tile, line, i % ring_rows, ring);
    if (i >= 2 * half_width)
      filter_column(tile, ring, (i + 1) % ring_rows, tile.row + i - 2 * half_width, points);
  }
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(find_ridge_points_in,
                                  (const RidgeTile& tile, std::vector<RidgePoint>& points),
                                  (tile, points))

}  // namespace

std::size_t ridge_tile_work(int half_width) {
  return static_cast<std::size_t>(6 * (2 * half_width + 1) + 1) * kTileWidth + 2 * half_width;
}

void find_ridge_points(const RidgeTile& tile, std::vector<RidgePoint>& points) {
  find_ridge_points_in(tile, points);
}

}  // namespace arcstart
