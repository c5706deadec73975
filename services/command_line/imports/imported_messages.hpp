// One scan from files, message by message.
#pragma once

#include <arcstart/image_t.hpp>
#include <arcstart/robot_pose_t.hpp>
#include <arcstart/scan_t.hpp>
#include <opencv2/core.hpp>
#include <string>

#include "services/command_line/imports/scan_folder.hpp"

namespace arcstart::command_line {

// A scan of a recording: the images of a folder, numbered on from those before.
struct ImportedScan {
  const ScanFolder* folder = nullptr;
  std::int8_t kind = 0;        // scan_t.BACKGROUND or WORKPIECE
  std::int64_t run_id = 0;     // of the recording; us, UTC
  std::int64_t first_seq = 0;  // of its images
  std::string job, part;

  // Around its images; us, UTC.
  std::int64_t begin_utime() const;  // also its scan_id
  std::int64_t end_utime() const;
};

// Its state as sensor_capture would tell it at this time; previous: the scan before, or null.
scan_t scan_message(const ImportedScan& scan, const ImportedScan* previous, std::int64_t utime);

// The frame of this place in the scan, its pixels (8-bit grey) as they are.
image_t image_message(const ImportedScan& scan, std::size_t place, const cv::Mat& grey);

robot_pose_t pose_message(const StampedPose& pose, std::int64_t run_id, std::int64_t seq);

}  // namespace arcstart::command_line
