// arcstart time-offset: how late the images are stamped, from sweeps.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace arcstart::command_line {

void add_time_offset_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
