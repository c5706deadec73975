// What is printed for programs to read.
#pragma once

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <system_error>

#include "common/input_error.hpp"

namespace arcstart::command_line {

// Throws InputError where something that was printed did not arrive, as on a full disk: then it is
// no result.
inline void check_standard_output() {
  if (std::cout.flush() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw InputError("standard output cannot be written: " + std::generic_category().message(errno));
}

}  // namespace arcstart::command_line
