// The poses captured so far, in a folder as `arcstart calibrate` reads it, and what is to be said
// of them.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/calibration/capture/pose_capture.hpp"
#include "services/calibration/files/calibration_set.hpp"
#include "services/calibration/solve/calibrate.hpp"
#include "services/calibration/solve/calibration_limits.hpp"

namespace arcstart::calibration {

struct KeptPose {
  View view;  // with its index; view.unusable says why it is not used
  std::optional<RigidTransform> T_camera_plate;  // known from three usable poses on
};

class CaptureDataset {
 public:
  // Goes on with what the folder holds; makes it where it is not there. plate_file is copied into
  // it. Throws CalibrationSetError.
  CaptureDataset(const std::string& folder, const std::string& plate_file);

  // Written to the disk before it is looked at. Throws CalibrationSetError where the disk takes it
  // not.
  void add(const CapturedPose& pose);
  // -1: all. False where there is none of that index.
  bool discard(int index);

  const std::vector<KeptPose>& poses() const { return poses_; }
  std::string advice() const;    // what the next pose should add
  CalibrationRun solve() const;  // of the usable poses
  // A page on what solve() gave, for a person.
  std::string report(const CalibrationRun& run, const CalibrationLimits& limits) const;
  const std::string& folder() const { return folder_; }

 private:
  void look(const CalibrationPose& pose, const cv::Mat& grid, const cv::Mat& laser);
  void write_poses() const;
  void locate();
  std::vector<View> usable() const;

  std::string folder_;
  Target plate_;
  cv::Size size_;  // of the images; px
  std::vector<KeptPose> poses_;
};

}  // namespace arcstart::calibration
