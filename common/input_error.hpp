// What a person gave cannot be used.
#pragma once

#include <stdexcept>

namespace arcstart {

// One line: which file or setting, what is wrong with it, what to do. Ends a program with exit 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace arcstart
