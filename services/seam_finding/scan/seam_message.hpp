// What was found, as seam_t says it.
#pragma once

#include <arcstart/seam_t.hpp>

#include "services/seam_finding/model/seam.hpp"

namespace arcstart::seam_finding {

// A message in which all that is not determined says so.
seam_t empty_seam();

// Verdict, seam, alternatives and the numbers of points.
void fill_in(seam_t& seam, const SeamResult& result);

}  // namespace arcstart::seam_finding
