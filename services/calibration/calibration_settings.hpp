#pragma once

#include "common/configuration.hpp"
#include "services/calibration/calibration_limits.hpp"

namespace arcstart {

// Section `calibration` of cell.yaml.
struct CalibrationSettings {
  std::string file = "calibration.yaml";  // the cell's calibration; looked at every second, so that
                                          // a new one is taken
  CalibrationLimits limits;               // what `arcstart calibrate` asks of a new one

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("file", file);
    limits.visit(visitor, positive());
  }
};

}  // namespace arcstart
