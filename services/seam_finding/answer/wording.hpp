// The seam finding's sentences, all of them, from its codes.
#pragma once

#include <string>
#include <vector>

#include "services/seam_finding/model/reason.hpp"

namespace arcstart::seam_finding {

// For a person; empty for none.
std::string in_words(const Reason& reason);

// One after the other, each closed by "; ".
std::string in_words(const std::vector<Reason>& remarks);

}  // namespace arcstart::seam_finding
