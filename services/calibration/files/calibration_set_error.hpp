#pragma once

#include "common/input_error.hpp"

namespace arcstart::calibration {

// One line: which file, what is wrong with it, what to do.
class CalibrationSetError : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace arcstart::calibration
