// The inner loops of the ridge detector: one tile of the image through the separable kernels.
#pragma once

#include <vector>

#include "services/extraction/image/grey_image.hpp"
#include "services/extraction/ridge/ridge_point.hpp"

namespace arcstart::extraction {

// Of a tile, px: the rows in reach, thrice filtered, stay in the first-level cache.
constexpr int kTileWidth = 16;

struct RidgeTile {
  const GreyImage& image;
  const float* smooth;  // taps 0 .. half_width, as GaussianKernels has them
  const float* first;
  const float* second;
  int half_width;
  float least_curvature;
  float farthest;                 // a ridge point from its pixel's middle, in u and in v; px
  int column, row, rows;          // the tile: 16 columns from column on, rows from row on
  int first_column, last_column;  // pixels outside them are left out
  float* work;                    // ridge_tile_work(half_width) floats, finite
};

std::size_t ridge_tile_work(int half_width);

// Appends the tile's ridge points, row by row.
void find_ridge_points(const RidgeTile& tile, std::vector<RidgePoint>& points);

}  // namespace arcstart::extraction
