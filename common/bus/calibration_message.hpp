// The calibration as a message, and back with every check a receiver owes it.
#pragma once

#include <arcstart/calibration_t.hpp>
#include <stdexcept>

#include "common/calibration.hpp"

namespace arcstart {

class CalibrationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// M is derived here.
calibration_t to_message(const Calibration& calibration);

// Throws CalibrationError, with why, where the set cannot be used or its M is not the one that
// follows from its camera and laser plane.
Calibration calibration_from_message(const calibration_t& message);

}  // namespace arcstart
