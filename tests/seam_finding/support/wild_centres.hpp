// From the pieces that the camera sees to a stripe's centres, as extraction gives them: one a pixel
// along the stripe, in segments, with its noise; and the down-sampling of reconstruction.
#pragma once

#include <cstdint>
#include <vector>

#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/wild/wild_scene.hpp"
#include "tests/seam_finding/support/wild_view.hpp"

namespace arcstart::seam_finding::synthetic {

struct WildCentre {
  Eigen::Vector2d pixel;
  Eigen::Vector2d across;  // unit, square to the stripe in the image
  double deviation;        // across the stripe; px
  int segment;
  std::int8_t segment_end;  // as in profile_t
  int object;               // -1: a ghost, or something on the tool
};

struct WildExtraction {
  int width, height;            // of the image; px
  double end_noise_px;          // of a segment's end, along the stripe
  double bend_blur_px;          // sigma by which bends are rounded
  double noise_factor;          // on the surfaces' noise
  double least_length_px = 10;  // shorter segments are left out
};

// surfaces: as surfaces_of() has them, those of the bands behind those of the objects.
std::vector<WildCentre> centres_of(const std::vector<WildPiece>& pieces,
                                   const std::vector<cell_simulator::WildSurface>& surfaces,
                                   const WildExtraction& extraction,
                                   cell_simulator::RandomStream& random);

// Of each segment every M-th, the last, and those between two of these that depart farthest from
// the line between them, by more than bend_px, and so on between these.
std::vector<WildCentre> thinned(const std::vector<WildCentre>& centres, int keep_every,
                                double bend_px);

}  // namespace arcstart::seam_finding::synthetic
