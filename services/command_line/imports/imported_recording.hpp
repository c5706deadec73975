// Scans from files as a recording of the running cell: what it would have sent, from its images on.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/calibration.hpp"
#include "common/configuration.hpp"
#include "services/command_line/imports/scan_folder.hpp"

namespace arcstart::command_line {

struct ImportedScans {
  ScanFolder work;
  std::optional<ScanFolder> background;  // wholly before the work
  Calibration calibration;               // names sensor and robot
  Configuration settings;  // of extraction, reconstruction and seam_finding, stated as their STATUS
  std::string job, part;   // of the work's scan
  std::string channel;     // of colour images: r, g or b; empty: their grey values
};

// Where background and work overlap in time, or the background is the later: moves it wholly before
// the work, and says so in notes.
void put_background_first(ImportedScans& scans, std::vector<std::string>& notes);

// Writes what the cell would have sent, in order of time, to a file that must not exist. It appears
// whole or not at all. The same scans give the same bytes. Nobody commanded the scans, and what is
// not in the files (exposure, controller's clock and frames) is 0, -1 or UNKNOWN. Throws
// ImportError or what says why an image or the settings cannot be used.
void write_recording(const std::string& path, const ImportedScans& scans,
                     const std::function<void(double share)>& on_progress,
                     std::vector<std::string>& notes);

}  // namespace arcstart::command_line
