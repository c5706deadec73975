// A scan's points parted into background and workpiece.
#pragma once

#include <vector>

#include "services/seam_finding/background/background.hpp"
#include "services/seam_finding/cloud/thinned_cloud.hpp"

namespace arcstart::seam_finding {

// A cloud's points by whether they are background, indices, rising.
struct Division {
  std::vector<int> background, left;
  int size() const { return static_cast<int>(background.size() + left.size()); }
};
// Goes on behind the last point that is divided already: a scan can be divided stripe by stripe.
void divide(const ScanCloud& scan, const Background& background, Division& division);

// The same of the thinned points.
Division division_of(const ThinnedCloud& thinned, const Division& whole);

}  // namespace arcstart::seam_finding
