#include "services/reconstruction/scan_calibration.hpp"

#include <utility>

namespace arcstart::reconstruction {

void ScanCalibration::take(std::shared_ptr<const Calibration> calibration) {
  if (of_scan_ && of_scan_->id != calibration->id) none_ = EmptyProfile::kCalibrationChanged;
  newest_ = std::move(calibration);
}

ScanCalibration::Answer ScanCalibration::of(std::int64_t scan_id) {
  if (scan_id == 0) return {newest_};
  if (scan_id != scan_id_) {
    scan_id_ = scan_id;
    of_scan_.reset();
    none_ = EmptyProfile::kNone;
  }
  if (none_ != EmptyProfile::kNone) return {nullptr, none_};
  if (!of_scan_) of_scan_ = newest_;
  return {of_scan_};
}

void ScanCalibration::give_up(std::int64_t scan_id) {
  if (scan_id != 0 && scan_id == scan_id_ && !of_scan_) none_ = EmptyProfile::kNoCalibration;
}

}  // namespace arcstart::reconstruction
