#include "services/reconstruction/scan_calibration.hpp"

#include <utility>

namespace arcstart::reconstruction {

void ScanCalibration::take(std::shared_ptr<const Calibration> calibration) {
  if (of_scan_ && of_scan_->id != calibration->id) none_ = "calibration changed within the scan";
  newest_ = std::move(calibration);
}

ScanCalibration::Answer ScanCalibration::of(std::int64_t scan_id) {
  if (scan_id == 0) return {newest_, ""};
  if (scan_id != scan_id_) {
    scan_id_ = scan_id;
    of_scan_.reset();
    none_.clear();
  }
  if (!none_.empty()) return {nullptr, none_};
  if (!of_scan_) of_scan_ = newest_;
  return {of_scan_, ""};
}

void ScanCalibration::give_up(std::int64_t scan_id) {
  if (scan_id != 0 && scan_id == scan_id_ && !of_scan_) none_ = "no calibration";
}

}  // namespace arcstart::reconstruction
