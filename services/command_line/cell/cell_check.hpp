// arcstart cell check
#pragma once

#include "common/options.hpp"

namespace arcstart::command_line {

// cell: the command of which it is a subcommand. given: set where it was asked for.
void add_cell_check(Command& cell, bool& given, int& exit_code);

}  // namespace arcstart::command_line
