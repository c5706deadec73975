#pragma once

#include "common/input_error.hpp"

namespace arcstart::command_line {

// One line: which file and line, what is wrong with it, what to do.
class ImportError : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace arcstart::command_line
