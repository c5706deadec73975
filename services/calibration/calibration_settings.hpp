#pragma once

#include "common/configuration.hpp"

namespace arcstart {

// Section `calibration` of cell.yaml.
struct CalibrationSettings {
  std::string file = "calibration.yaml";  // the cell's calibration; looked at every second, so that
                                          // a new one is taken

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("file", file);
  }
};

}  // namespace arcstart
