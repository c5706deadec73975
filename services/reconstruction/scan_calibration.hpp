// Which calibration holds for a stripe: that of its scan's first stripe.
#pragma once

#include <cstdint>
#include <memory>

#include "common/calibration.hpp"
#include "services/reconstruction/empty_profile.hpp"

namespace arcstart::reconstruction {

class ScanCalibration {
 public:
  // The newest calibration. Another id than that of the scan under way leaves the rest of that scan
  // without.
  void take(std::shared_ptr<const Calibration> calibration);

  struct Answer {
    std::shared_ptr<const Calibration> calibration;
    // Why there is none. Without either, no calibration is known yet.
    EmptyProfile none = EmptyProfile::kNone;
  };
  // For the next stripe; 0 is a stripe outside a scan, for which the newest holds.
  Answer of(std::int64_t scan_id);

  // This scan has waited long enough: it stays without a calibration.
  void give_up(std::int64_t scan_id);

  const std::shared_ptr<const Calibration>& newest() const { return newest_; }

 private:
  std::shared_ptr<const Calibration> newest_;
  std::int64_t scan_id_ = 0;                    // the scan under way
  std::shared_ptr<const Calibration> of_scan_;  // its calibration, null before one is known
  EmptyProfile none_ = EmptyProfile::kNone;     // why it has none from now on
};

}  // namespace arcstart::reconstruction
