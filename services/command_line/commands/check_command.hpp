// arcstart check: whether a calibration still holds, without a plate.
#pragma once

#include <CLI/CLI.hpp>

namespace arcstart::command_line {

void add_check_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
