// Why a segment of the stripe ends where it does.
#pragma once

#include <vector>

#include "services/extraction/image/grey_image.hpp"
#include "services/extraction/lines/stripe_path.hpp"
#include "services/extraction/ridge/ridge.hpp"

namespace arcstart::extraction {

// Values as in stripe_t.
enum class SegmentEnd : std::int8_t {
  kContinues = 0,   // not an end
  kEdge = 1,        // the surface ends, or another lies before it
  kGap = 2,         // the stripe goes on in line, on the far side of a gap
  kBorder = 3,      // of the image
  kSaturation = 4,  // runs into an area that is all white
};

// At the first and the last point of branches[index].
struct BranchEnds {
  SegmentEnd first, last;
};
BranchEnds branch_ends(const GreyImage& image, const std::vector<RidgePoint>& points,
                       const StripePath& selection, std::size_t index, double sigma, int margin);

}  // namespace arcstart::extraction
