// frames.csv and frames/: images of a scan and when each was received.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace arcstart::command_line {

struct StampedFrame {
  int index = 0;
  std::int64_t utime = 0;  // as given; us, UTC
  std::string image;       // file
};

// The images of FOLDER/frames, NNNN.png, .jpg, .jpeg, .bmp, .tif or .tiff, that FOLDER/frames.csv
// stamps, by index, their times rising. Images without a stamp are left out and told in notes. The
// images themselves are not read. Throws ImportError.
std::vector<StampedFrame> read_frame_folder(const std::string& folder,
                                            std::vector<std::string>& notes);

}  // namespace arcstart::command_line
