// arcstart check: whether a calibration still holds, without a plate.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace arcstart::command_line {

void add_check_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
