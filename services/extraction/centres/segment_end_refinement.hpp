// Where the light of a segment ends.
#pragma once

#include <vector>

#include "services/extraction/centres/stripe_centre.hpp"
#include "services/extraction/image/grey_image.hpp"

namespace arcstart::extraction {

// A ridge's last point is a whole pixel's, and how far it lies from where the light ends goes with
// the slant at which an edge cuts the stripe. On the stripe's middle line, though, the light is
// half as bright as before just there, whatever the slant and the blur: stripe and blur look the
// same turned by half a circle, and turned about that point what is lit becomes what is dark.
//
// So the first and the last centre of each chosen segment that ends at an edge or a gap are put
// there, on the line of the centres far enough from the end not to feel it, and those beyond are
// dropped. Brightness is the bend across the stripe, which no even background changes. Where that
// place cannot be told (the segment is short, its top white, another stripe is near, or the light
// does not stop), centres at the end of less than half the strength farther in are dropped, and the
// rest stays as found.
void refine_segment_ends(const GreyImage& image, std::vector<StripeCentre>& centres);

}  // namespace arcstart::extraction
