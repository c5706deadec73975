// arcstart replay: the whole pipeline on recordings.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace arcstart::command_line {

// exit_code: 0 every workpiece scan found (or there are backgrounds alone, and all are stored), 1
// not, 2 bad input.
void add_replay_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
