// What a scan owes to the difference between the clocks that stamp its images and its positions:
// each point is displaced by the tool's velocity times that difference.
#pragma once

#include "services/seam_finding/scan/scan_collector.hpp"

namespace arcstart::seam_finding {

// By how much stamps of images and positions may disagree, s: the difference and its bound. 0 where
// nobody has measured it, as in recordings of former versions.
double clock_doubt(const scan_t& state);

// Of the tool between profiles with points: the speed that nine in ten do not exceed; mm/s, 0 where
// there are no two.
double speed_of(const CollectedScan& scan);

// Why the scan must not be evaluated: the clocks surely differ by what makes a displacement of more
// than 0.1 mm, or perhaps by what makes one of more than 1 mm. Empty where it may be.
ScanRefusal clock_refusal(const CollectedScan& scan);

}  // namespace arcstart::seam_finding
