// arcstart time-offset: how late the images are stamped, from sweeps.
#pragma once

#include <CLI/CLI.hpp>

namespace arcstart::command_line {

void add_time_offset_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
