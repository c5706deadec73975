// Chains cut where they meet: the strands that lead from one junction of lines to the next.
#pragma once

#include <array>
#include <vector>

#include "services/extraction/lines/linking.hpp"
#include "services/extraction/ridge/ridge.hpp"

namespace arcstart::extraction {

// Which way the stripe runs through the image, and where along it ridge points are looked for at
// all.
struct Sight {
  bool along_rows = false;  // the stripe runs down the image: one centre a row, not a column
  int first = 0, last = 0;  // columns, or rows
  float least_way = 15;     // px along the image; what leads less far is a scrap
};

// A chain, or the part of one between the places where ends of others meet it.
struct Strand {
  static constexpr float kStep = 5;  // px along the image between strands that follow on each other

  Chain points;
  // At its first and its last point:
  std::array<int, 2> junction{-1, -1};  // with other strands; -1 for none
  std::array<bool, 2> leads_on{};  // to a junction, over a step to a strand that begins in the next
                                   // column, or out of sight
  bool reflection = false;

  bool hangs() const { return !(leads_on[0] && leads_on[1]); }
};

// Cuts the chains where an end of another lies within reach (px), or would after going on straight
// for four times as far, and names the junctions.
FrameVector<Strand> cut_at_junctions(const std::vector<RidgePoint>& points,
                                     const std::vector<Chain>& chains, const Sight& sight,
                                     double reach, Memory memory = heap());

}  // namespace arcstart::extraction
