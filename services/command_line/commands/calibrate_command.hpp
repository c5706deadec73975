// arcstart calibrate: a calibration from a folder of images and poses.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace arcstart::command_line {

// exit_code: 0 made and within its limits, 1 refused or not within them, 2 bad input.
void add_calibrate_command(CLI::App& parent, int& exit_code);

}  // namespace arcstart::command_line
