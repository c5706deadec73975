// From a scan's messages to its answer, seam_t.
#pragma once

#include <arcstart/seam_t.hpp>
#include <memory>
#include <string>

#include "common/calibration.hpp"
#include "services/seam_finding/background/background.hpp"
#include "services/seam_finding/background/segmentation.hpp"
#include "services/seam_finding/cloud/downsampled_cloud.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/referee/plate_view.hpp"
#include "services/seam_finding/scan/scan_collector.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// What became of the images of a scan.
struct ScanBalance {
  int stripes = 0;        // profiles with points
  int empty = 0;          // a whole image showed nothing within the working range
  int overlit = 0;        // too much light to tell a stripe
  int unusable = 0;       // laser off, or not readable
  int without_pose = 0;   // no position or calibration for them
  int images_lost = 0;    // at the camera
  int incomplete = 0;     // of those, begun and not whole
  int profiles_lost = 0;  // between the camera and here

  std::string losses() const;  // "2 images lost at the camera; ", empty for none
};
ScanBalance balance_of(const CollectedScan& scan);

// Points and stripes in order of seq, a kMissing stripe for each of which is not known what it
// would have shown.
ScanCloud cloud_of(const CollectedScan& scan);

// The calibration of its first points; empty where there are none.
std::string calibration_of(const CollectedScan& scan);
// Not all of it was carried to the base by that one.
bool calibration_changed(const CollectedScan& scan);

// A background scan, ready for comparison.
class StoredBackground {
 public:
  StoredBackground(const CollectedScan& scan, const SeamFindingSettings& settings);
  std::int64_t scan_id() const { return scan_id_; }
  const std::string& calibration_id() const { return calibration_id_; }
  const std::string& job() const { return job_; }  // that it was made for, empty for none
  const Background& model() const { return *model_; }
  std::size_t points() const { return cloud_->points.size(); }

 private:
  std::int64_t scan_id_;
  std::string calibration_id_, job_;
  std::unique_ptr<ScanCloud> cloud_;  // the model refers to it
  std::unique_ptr<Background> model_;
};

// Why a background scan is not complete, empty where it can serve. Single stripes may be missing,
// for the surface is known from those beside them: no more than one in twenty, no two in a row.
ScanRefusal background_error(const CollectedScan& scan, const SeamFindingSettings& settings);

// A workpiece scan before the seam is sought: its cloud, downsampled, thinned out for the referee,
// and segmented where there is a background.
struct PreparedScan {
  ScanCloud cloud;
  Segmentation segmentation;
  DownsampledCloud downsampled;
  ThinnedScan thinned;
};
PreparedScan prepare(const CollectedScan& scan, const StoredBackground* background);

// The answer to a workpiece scan; background, calibration of the scan: nullptr where there is none.
// prepared: by that background.
seam_t answer_workpiece(const CollectedScan& scan, const PreparedScan& prepared,
                        const StoredBackground* background, const SeamFindingSettings& settings,
                        const Calibration* calibration = nullptr);
seam_t answer_workpiece(const CollectedScan& scan, const StoredBackground* background,
                        const SeamFindingSettings& settings,
                        const Calibration* calibration = nullptr);
// The receipt for a background scan; error: why it cannot serve, empty where it is stored.
seam_t answer_background(const CollectedScan& scan, const ScanRefusal& error);

}  // namespace arcstart::seam_finding
