// Where the ends of chains run into other chains.
#pragma once

#include <vector>

#include "services/extraction/lines/linking.hpp"
#include "services/extraction/ridge/ridge.hpp"

namespace arcstart::extraction {

// Which chain a point is in, -1 for none, and the how-many-th it is there.
struct ChainPlace {
  int chain = -1, position = -1;
};

// An end of one chain lies at a point of another.
struct ChainContact {
  int end, point;
};

// For each end in order, a meeting with each other chain, in order, that has a point within reach
// (px) of it, or of the way straight on for four times as far: with the point nearest to the end,
// the first of those equally near. places: of each point.
FrameVector<ChainContact> find_contacts(const std::vector<RidgePoint>& points,
                                        const std::vector<Chain>& chains,
                                        const FrameVector<ChainPlace>& places, double reach,
                                        Memory memory);

}  // namespace arcstart::extraction
