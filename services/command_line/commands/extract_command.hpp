// arcstart extract: the stripe's centres in images from files.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace arcstart::command_line {

// exit_code: 0 a stripe found in at least one image, 1 in none, 2 bad input.
void add_extract_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
