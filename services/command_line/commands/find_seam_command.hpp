// arcstart find-seam: the weld seam in a point cloud from a file.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace arcstart::command_line {

// exit_code: 0 found, 1 ambiguous or refused, 2 bad input.
void add_find_seam_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
