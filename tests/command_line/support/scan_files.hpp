// A recorded scan as the files that somebody without arcstart would have: images, stamps, poses.
#pragma once

#include <cstdint>
#include <string>

#include "tests/command_line/support/synthetic_recording.hpp"

namespace arcstart::test {

struct PoseWriting {
  std::string format = "wxyz", unit = "mm";  // as --pose-format and --pose-units have them
  bool header = true;
};

// FOLDER/frames/NNNN.png, frames.csv and poses.csv of one scan, with half a second of positions
// before its first image and after its last.
void write_scan_files(const std::string& folder, const Events& events, std::int64_t scan_id,
                      const PoseWriting& writing = {});

void write_text(const std::string& path, const std::string& text);
std::string read_text(const std::string& path);

}  // namespace arcstart::test
