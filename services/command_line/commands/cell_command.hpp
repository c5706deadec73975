// `arcstart cell`: the simulated cell, from the command line.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace arcstart::command_line {

// Adds the subcommand; it sets exit_code when it has run: 0 done or found, 1 no answer or no right
// seam, 2 bad input.
void add_cell_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
