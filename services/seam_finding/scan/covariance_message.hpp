// The part of the answer's deviations that comes from the calibration.
#pragma once

#include <arcstart/seam_t.hpp>

#include "common/calibration.hpp"
#include "services/seam_finding/scan/scan_collector.hpp"

namespace arcstart::seam_finding {

// start_systematic and end_systematic of a seam that was found; says in its remark why they are not
// determined. calibration: that of the scan, nullptr where it is not known.
void fill_in_calibration_covariance(seam_t& seam, const CollectedScan& scan,
                                    const Calibration* calibration);

}  // namespace arcstart::seam_finding
