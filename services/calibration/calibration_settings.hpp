// Section `calibration` of cell.yaml.
#pragma once

#include <string>

#include "common/configuration.hpp"
#include "services/calibration/solve/calibration_limits.hpp"

namespace arcstart::calibration {

struct CalibrationSettings {
  std::string file = "calibration.yaml";  // the cell's calibration; looked at every second, so that
                                          // a new one is taken
  CalibrationLimits limits;               // what `arcstart calibrate` asks of a new one

  // --- making one in the cell: one command a pose, see LASER0_CALIBRATION_COMMAND
  std::string plate = "";  // the plate's description, plate.yaml; empty: none is made here
  std::string folder = "calibration";  // the poses captured, as `arcstart calibrate` reads them
  std::string tool = "";               // the robot's tool frame that the positions are of, a name
  double grid_exposure_us = 20000;     // of the plate's image, laser off
  double laser_exposure_us = 2000;     // of the stripe's
  double still_duration_s = 0.5;       // that the robot must have stood before
  double still_distance_mm = 0.2;      // within this: above the positions' noise
  double still_angle_deg = 0.02;       // and this

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("file", file);
    limits.visit(visitor, positive());
    visitor("plate", plate);
    visitor("folder", folder);
    visitor("tool", tool);
    visitor("grid_exposure_us", grid_exposure_us, between(1, 1e6));
    visitor("laser_exposure_us", laser_exposure_us, between(1, 1e6));
    visitor("still_duration_s", still_duration_s, between(0.05, 60));
    visitor("still_distance_mm", still_distance_mm, between(0.001, 10));
    visitor("still_angle_deg", still_angle_deg, between(0.001, 5));
  }
};

}  // namespace arcstart::calibration
