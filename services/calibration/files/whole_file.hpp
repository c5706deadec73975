// Files that a running cell reads.
#pragma once

#include <string>

#include "services/calibration/files/calibration_set_error.hpp"

namespace arcstart::calibration {

// Writes the text beside and renames it: nobody reads half of it, and a full disk leaves what was
// there. Throws CalibrationSetError.
void write_whole(const std::string& path, const std::string& text);

// Likewise for a calibration, which may be in force: another one that stood there is kept beside,
// as .former.yaml. Throws CalibrationSetError.
void replace_calibration_file(const std::string& path, const std::string& text);

}  // namespace arcstart::calibration
