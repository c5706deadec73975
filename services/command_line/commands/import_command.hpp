// arcstart import: what others recorded in files, as arcstart's own.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace arcstart::command_line {

void add_import_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
