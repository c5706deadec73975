// Ridge points linked into chains along the line they lie on.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "services/extraction/image/frame_arena.hpp"
#include "services/extraction/ridge/ridge.hpp"

namespace arcstart::extraction {

struct LinkingSettings {
  double strong_curvature =
      0;  // hysteresis: a chain holds at least three points of this curvature; grey values / px^2
  int fewest_points = 10;  // of a chain
  // Of all chains together. Where there are more, the strongest chains (by the sum of their
  // curvatures) are kept that find room, so that an image full of lines costs no more than others.
  int most_points = std::numeric_limits<int>::max();
};

// Indices of points, in order along the line.
using Chain = FrameVector<int>;

class Linker {
 public:
  // points in raster order. Two points are linked where each is the other's best neighbour on that
  // side: near, ahead along the tangent, and of like direction. So a chain grows to both sides,
  // does not depend on where one begins, and never forks. Chains come in order of their first point
  // in the raster, in the memory given.
  void link(const std::vector<RidgePoint>& points, const LinkingSettings& settings,
            std::vector<Chain>& chains, Memory memory = heap());
  bool left_out() const { return left_out_; }  // chains of the last points, for want of room

 private:
  void find_neighbours(const std::vector<RidgePoint>& points);
  void follow(int start, int side, std::size_t size);

  // Sides 0 and 1: against and along the tangent (-normal_v, normal_u).
  std::vector<std::array<int, 2>> best_, linked_;
  std::vector<std::array<float, 2>> lowest_;  // what going on to the best costs
  std::vector<char> taken_;
  std::vector<int> row_begin_, followed_;
  bool left_out_ = false;
};

}  // namespace arcstart::extraction
