// The sigma that each place of a stripe wants whose width changes along it.
#pragma once

#include <vector>

#include "services/extraction/image/frame_arena.hpp"
#include "services/extraction/lines/stripe_path.hpp"

namespace arcstart::extraction {

struct ScaleMapSettings {
  double per_width = 1.3;         // sigma for a width of 1
  double least = 0, largest = 0;  // sigma; px
};

// Into sigmas, of each point that the chosen branches name: per_width times the median width of its
// neighbours in the branch, rounded to a quarter of an octave, so that a stripe takes few kernels
// and a centre moves little from one to the next. 0 for other points, and for a branch without
// widths. widths: of each point; px, 0 where not known.
void map_scales(const std::vector<Branch>& branches, const std::vector<float>& widths,
                const ScaleMapSettings& settings, std::vector<float>& sigmas, Memory memory);

}  // namespace arcstart::extraction
