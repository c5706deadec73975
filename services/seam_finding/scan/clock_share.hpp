// What a scan owes to the difference between the clocks that stamp its images and its positions:
// each point is displaced by the tool's velocity times that difference.
#pragma once

#include <string>

#include "services/seam_finding/scan/scan_collector.hpp"

namespace arcstart::seam_finding {

// By how much stamps of images and positions may disagree, s: the difference and its bound. 0 where
// nobody has measured it, as in recordings of former versions.
double clock_doubt(const scan_t& state);

// Of the tool between profiles with points: the speed that nine in ten do not exceed; mm/s, 0 where
// there are no two.
double speed_of(const CollectedScan& scan);

// Why the scan must not be evaluated: the clocks surely displace it by more than allowed_mm, or
// perhaps by more than ten times that. Empty where it may be.
ScanRefusal clock_refusal(const CollectedScan& scan, double allowed_mm);

// Why a seam of this scan must not be acted on (CLOCKS_APART): the clocks perhaps displace it by
// more than allowed_mm, or nobody has compared them. A remark; empty where it may be.
std::string clock_remark(const CollectedScan& scan, double allowed_mm);

}  // namespace arcstart::seam_finding
