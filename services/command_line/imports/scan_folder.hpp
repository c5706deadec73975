// A scan that somebody recorded in files: frames/, frames.csv and poses.csv.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/command_line/imports/frame_folder.hpp"
#include "services/command_line/imports/pose_file.hpp"

namespace arcstart::command_line {

struct ScanFolder {
  std::string path;
  std::vector<StampedFrame> frames;  // one or more, times rising
  std::vector<StampedPose> poses;    // two or more, times rising

  // Of all that is in it; us, UTC.
  std::int64_t first_utime() const;
  std::int64_t last_utime() const;
  // All of it, later by so much; us.
  void shift(std::int64_t by);
};

// time_offset: as the calibration has it, added to a frame's time to look up the pose; s. There
// must be a pose before and after each frame. Throws ImportError.
ScanFolder read_scan_folder(const std::string& path, const PoseConvention& convention,
                            double time_offset, std::vector<std::string>& notes);

}  // namespace arcstart::command_line
