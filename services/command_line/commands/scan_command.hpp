// arcstart scan: runs one scan in a live cell and prints its answer as JSON.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace arcstart::command_line {

// exit_code: 0 found or background stored, 1 not, 2 bad input.
void add_scan_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
