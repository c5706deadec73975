// arcstart monitor: what is on the bus, a line a channel.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace arcstart::command_line {

// exit_code: 0 something was heard, 1 nothing was, 2 bad input.
void add_monitor_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
