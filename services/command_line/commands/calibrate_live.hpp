// The operator's side of a calibration in the cell: pose after pose, then the solution.
#pragma once

#include <string>

#include "common/service.hpp"

namespace arcstart::command_line {

struct LiveCalibration {
  std::string cell;  // the cell's file, for its bus; empty: the defaults
  Instance instance;
  int poses = 20;          // in a simulated cell, which drives them itself
  bool anew = true;        // poses captured before are discarded
  std::int64_t seed = -1;  // of the simulated plate; -1: as it is
};

// In a simulated cell without a hand; in a real one a person moves the robot and presses Enter.
// Words on standard error, the service's verdict on standard output. Exit code: 0 made, 1 not, 2
// bad input.
int calibrate_live(const LiveCalibration& request);

}  // namespace arcstart::command_line
