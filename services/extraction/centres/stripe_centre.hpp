// A centre of the stripe, as the extraction gives it away.
#pragma once

#include <cstdint>

#include "services/extraction/centres/segment_ends.hpp"

namespace arcstart::extraction {

struct StripeCentre {
  float u, v;       // px, pixel centres at integers
  float strength;   // N of Eq. 3; grey values
  float width;      // standard deviation of the profile; px, 0 where not measured
  float deviation;  // standard deviation across the stripe; px
  std::int16_t segment;
  bool chosen;     // else a second candidate
  SegmentEnd end;  // why its segment ends here
};

}  // namespace arcstart::extraction
