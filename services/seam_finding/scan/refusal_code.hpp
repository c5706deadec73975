// The codes that a robot or an operator's program reads, from the seam finding's own.
#pragma once

#include <cstdint>

#include "services/seam_finding/model/reason.hpp"

namespace arcstart::seam_finding {

// A constant of seam_t, in ranges by what helps; 0 for no reason, and for one that only ranks an
// alternative.
std::int16_t refusal_code(const Reason& reason);

}  // namespace arcstart::seam_finding
