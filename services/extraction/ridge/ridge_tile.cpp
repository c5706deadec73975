#include "services/extraction/ridge/ridge_tile.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "common/instruction_sets.hpp"
#include "services/extraction/image/simd_vectors.hpp"
#include "services/extraction/ridge/ridge_extrema.hpp"

namespace arcstart::extraction {
namespace {

constexpr int kRows = 4;          // output rows at once: each row in reach is loaded once for them
constexpr int kRowsOfChunk = 32;  // output rows for which the filtered rows are kept

int up_to(int size, int multiple) { return (size + multiple - 1) / multiple * multiple; }

// Where a tile's values are kept, each row at a whole cache line: grey values, and those filtered
// along u by smooth, first and second; from half_width above the chunk's first output row on.
struct Planes {
  int grey_stride, rows;
  float *grey, *smooth, *first, *second;

  Planes(int half_width, float* work)
      : grey_stride(up_to(kTileWidth + 2 * half_width, 8)),
        rows(up_to(kRowsOfChunk + 2 * half_width, kRows) + kRows) {
    constexpr std::uintptr_t kLine = 64;
    const auto address = reinterpret_cast<std::uintptr_t>(work);
    grey = work + (kLine - address % kLine) % kLine / sizeof(float);
    smooth = grey + up_to(rows * grey_stride, 16);
    first = smooth + rows * kTileWidth;
    second = first + rows * kTileWidth;
  }
  std::size_t size() const {
    return static_cast<std::size_t>(rows) * (grey_stride + 3 * kTileWidth) + 32;
  }
};

// Eight grey values as floats. The compiler takes a plain loop apart.
template <int kFloats>
ARCSTART_INLINE_BODY void widen(const std::uint8_t* from, float* to) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)  // builtins of GCC's own
  if constexpr (kFloats >= 8) {
    typedef char Bytes __attribute__((vector_size(16)));
    typedef std::int64_t Longs __attribute__((vector_size(16)));
    std::int64_t bytes;
    std::memcpy(&bytes, from, sizeof bytes);
    store(to,
          __builtin_convertvector(__builtin_ia32_pmovzxbd256((Bytes)Longs{bytes, 0}), Lanes<8>));
    return;
  }
#endif
  for (int i = 0; i < 8; ++i) to[i] = from[i];
}

// Grey values of an image row from half_width left of the tile on, mirrored at the border.
template <int kFloats>
ARCSTART_INLINE_BODY void load_greys(const RidgeTile& tile, int v, int grey_stride, float* greys) {
  const std::uint8_t* row = tile.image.row(reflect_101(v, tile.image.height));
  const int begin = tile.column - tile.half_width, size = kTileWidth + 2 * tile.half_width;
  // Rows lie too far apart for the processor to see what comes next. What lies left of the last
  // pixel has mostly come with the tile before.
  __builtin_prefetch(row + begin + size - 1 + 12 * tile.image.stride);
  if (begin >= 0 && begin + grey_stride <= tile.image.width)
    for (int k = 0; k < grey_stride; k += 8) widen<kFloats>(row + begin + k, greys + k);
  else
    for (int k = 0; k < size; ++k) greys[k] = row[reflect_101(begin + k, tile.image.width)];
}

// Rows filtered along u at once: as many as there are registers for.
template <int kFloats>
constexpr int kRowsAlongU = kFloats == 16 ? 4 : 2;

// Their loads are unaligned, for which eight floats at a time are best anywhere.
template <int kFloats>
ARCSTART_INLINE_BODY void filter_rows(const RidgeTile& tile, const Planes& planes, int row) {
  constexpr int kWidth = std::min(kFloats, 8), kAcross = kTileWidth / kWidth,
                kCount = kRowsAlongU<kFloats> * kAcross;
  using Values = Lanes<kWidth>;
  const float* centre = planes.grey + row * planes.grey_stride + tile.half_width;
  const auto place = [&](int i) {
    return centre + i / kAcross * planes.grey_stride + i % kAcross * kWidth;
  };
  Values smooth[kCount], first[kCount], second[kCount];
  for (int i = 0; i < kCount; ++i) {
    const Values grey = load<kWidth>(place(i));
    smooth[i] = grey * tile.smooth[0];
    second[i] = grey * tile.second[0];
    first[i] = Values{};
  }
  for (int k = 1; k <= tile.half_width; ++k) {
    const float g0 = tile.smooth[k], g1 = tile.first[k], g2 = tile.second[k];
    for (int i = 0; i < kCount; ++i) {
      Values right = load<kWidth>(place(i) + k), left = load<kWidth>(place(i) - k);
      keep<kFloats>(right);
      keep<kFloats>(left);
      const Values sum = right + left;
      smooth[i] += sum * g0;
      first[i] += (right - left) * g1;
      second[i] += sum * g2;
    }
  }
  for (int i = 0; i < kCount; ++i) {
    const int at = row * kTileWidth + i * kWidth;
    store(planes.smooth + at, smooth[i]);
    store(planes.first + at, first[i]);
    store(planes.second + at, second[i]);
  }
}

// Four output rows of a plane filtered along v with even or odd taps. at: the first one's place.
template <bool kOdd, int kFloats>
ARCSTART_INLINE_BODY void filter_columns(const float* at, const float* taps, int half_width,
                                         Lanes<kFloats> out[kRows]) {
  Lanes<kFloats> below[kRows], above[kRows];  // the rows k below and above each output row
  for (int i = 0; i < kRows; ++i) {
    below[i] = above[i] = load<kFloats>(at + i * kTileWidth);
    out[i] = kOdd ? Lanes<kFloats>{} : below[i] * taps[0];
  }
#pragma GCC unroll 4
  for (int k = 1; k <= half_width; ++k) {
    for (int i = 0; i + 1 < kRows; ++i) below[i] = below[i + 1];
    for (int i = kRows - 1; i > 0; --i) above[i] = above[i - 1];
    below[kRows - 1] = load<kFloats>(at + (kRows - 1 + k) * kTileWidth);
    above[0] = load<kFloats>(at - k * kTileWidth);
    const float tap = taps[k];
    for (int i = 0; i < kRows; ++i)
      out[i] += (kOdd ? below[i] - above[i] : below[i] + above[i]) * tap;
  }
}

// Negative where the smaller eigenvalue is -limit or less: the determinant of (Hessian + limit) is
// negative, or its trace is. No square root, and no comparison but of signs.
template <int kFloats>
ARCSTART_INLINE_BODY typename Register<kFloats>::Mask strong(Lanes<kFloats> uu, Lanes<kFloats> uv,
                                                             Lanes<kFloats> vv, float limit) {
  using Mask = typename Register<kFloats>::Mask;
  const Lanes<kFloats> a = uu + limit, b = vv + limit;
  return (Mask)(a * b - uv * uv) | (Mask)(a + b);
}

// Of whole registers of pixels, or of all there are.
template <int kFloats>
ARCSTART_INLINE_BODY void take_points(const RidgeTile& tile, bool all, BentPixels<kFloats>& pixels,
                                      std::vector<RidgePoint>& points) {
  int begin = 0;
  for (; all ? begin < pixels.count : begin + kFloats <= pixels.count; begin += kFloats) {
    Extrema<kFloats> e;
    find_extrema(tile.least_curvature, tile.farthest, pixels, begin, e);
    std::uint32_t bits = signs_of<kFloats>(load_as<typename Register<kFloats>::Mask>(e.is_ridge));
    if (pixels.count - begin < kFloats) bits &= (1u << (pixels.count - begin)) - 1;
    for (; bits != 0; bits &= bits - 1) {
      const int i = std::countr_zero(bits);
      points.push_back({e.u[i], e.v[i], e.nu[i], e.nv[i], e.curvature[i], e.column[i], e.row[i]});
    }
  }
  if (begin > 0) keep_from(begin, pixels);
}

// Bit i: column i belongs to the tile.
std::uint32_t columns_within(const RidgeTile& tile) {
  std::uint32_t bits = 0;
  for (int i = 0; i < kTileWidth; ++i)
    if (tile.column + i >= tile.first_column && tile.column + i <= tile.last_column)
      bits |= 1u << i;
  return bits;
}

// Bit i: bent up more than down, no bright line.
template <int kFloats>
ARCSTART_INLINE_BODY std::uint32_t bent_up(Lanes<kFloats> uu, Lanes<kFloats> vv) {
  return signs_of<kFloats>((typename Register<kFloats>::Mask)(0 - (uu + vv)));
}

template <int kFloats>
ARCSTART_INLINE_BODY void find_in_chunk(const RidgeTile& tile, const Planes& planes, int first_row,
                                        int rows, BentPixels<kFloats>& pixels,
                                        std::vector<RidgePoint>& points) {
  const int half_width = tile.half_width;
  const std::uint32_t columns = columns_within(tile);
  for (int row = 0; row < rows; row += kRows)
    for (int c = 0; c < kTileWidth; c += kFloats) {
      const int at = (row + half_width) * kTileWidth + c;
      Lanes<kFloats> u[kRows], v[kRows], uu[kRows], uv[kRows], vv[kRows];
      filter_columns<false, kFloats>(planes.second + at, tile.smooth, half_width, uu);
      filter_columns<true, kFloats>(planes.first + at, tile.first, half_width, uv);
      filter_columns<false, kFloats>(planes.smooth + at, tile.second, half_width, vv);
      std::uint32_t bits[kRows], any = 0;
      for (int i = 0; i < kRows; ++i) {
        bits[i] = signs_of<kFloats>(strong<kFloats>(uu[i], uv[i], vv[i], tile.least_curvature)) &
                  (row + i < rows ? columns >> c : 0);
        any |= bits[i];
      }
      if (any == 0) continue;
      filter_columns<false, kFloats>(planes.first + at, tile.smooth, half_width, u);
      filter_columns<true, kFloats>(planes.smooth + at, tile.first, half_width, v);
      // Only now, when those added last have long been written, so that none waits for it.
      take_points(tile, false, pixels, points);
      for (int i = 0; i < kRows; ++i)
        if (bits[i] != 0)
          add_pixels<kFloats>(bits[i] & ~bent_up<kFloats>(uu[i], vv[i]), u[i], v[i], uu[i], uv[i],
                              vv[i], tile.column + c, first_row + row + i, pixels);
    }
}

template <int kFloats>
ARCSTART_INLINE_BODY void find_ridge_points_in_body(const RidgeTile& tile,
                                                    std::vector<RidgePoint>& points) {
  const int half_width = tile.half_width;
  const Planes planes(half_width, tile.work);
  BentPixels<kFloats> pixels;
  for (int done = 0; done < tile.rows; done += kRowsOfChunk) {
    const int rows = std::min(kRowsOfChunk, tile.rows - done);
    if (done > 0)  // the last rows of the chunk before are in reach of this one's
      for (float* values : {planes.smooth, planes.first, planes.second})
        std::memmove(values, values + kRowsOfChunk * kTileWidth,
                     sizeof(float) * 2 * half_width * kTileWidth);
    const int begin = done > 0 ? 2 * half_width : 0, end = rows + 2 * half_width;
    for (int i = begin; i < end; ++i)
      load_greys<kFloats>(tile, tile.row + done + i - half_width, planes.grey_stride,
                          planes.grey + i * planes.grey_stride);
    for (int i = begin; i < end; i += kRowsAlongU<kFloats>) filter_rows<kFloats>(tile, planes, i);
    find_in_chunk<kFloats>(tile, planes, tile.row + done, rows, pixels, points);
  }
  take_points(tile, true, pixels, points);
}
ARCSTART_FOR_EACH_INSTRUCTION_SET(find_ridge_points_in,
                                  (const RidgeTile& tile, std::vector<RidgePoint>& points),
                                  (tile, points))

}  // namespace

std::size_t ridge_tile_work(int half_width) { return Planes(half_width, nullptr).size(); }

void find_ridge_points(const RidgeTile& tile, std::vector<RidgePoint>& points) {
  find_ridge_points_in(tile, points);
}

}  // namespace arcstart::extraction
