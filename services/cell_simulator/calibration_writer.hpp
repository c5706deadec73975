// The true calibration as the cell's calibration file, which the calibration service reads.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "services/cell_simulator/image/sensor_camera.hpp"

namespace arcstart::cell_simulator {

class CalibrationWriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct TrueCalibration {
  std::string sensor, robot, tool;  // their names in the cell
  TrueSensor truth;
  double time_offset;  // minus the image delay; s
};

// The file's text. Its id is the fingerprint of all that follows the id's line. made: us, UTC.
std::string calibration_text(const TrueCalibration& calibration, std::int64_t made);

// Writes the file as a whole or not at all. Where one is there that differs in nothing but when it
// was made, it is left as it is: backgrounds are bound to its id. Returns whether it was written.
// Throws CalibrationWriteError.
bool write_calibration(const std::string& path, const TrueCalibration& calibration,
                       std::int64_t made);

}  // namespace arcstart::cell_simulator
