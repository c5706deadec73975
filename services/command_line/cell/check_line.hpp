// A line of `arcstart cell check`: what was looked at, how it stands, and what mends it.
#pragma once

#include <string>
#include <vector>

namespace arcstart::command_line {

struct CheckLine {
  std::string what;       // "clock"
  std::string words;      // how it stands; one line
  std::string mended_by;  // a command, or what to do; empty: all is well
};

// One line each, and beneath what mends it. in_colour: for a terminal.
std::string to_text(const std::vector<CheckLine>& lines, bool in_colour);

}  // namespace arcstart::command_line
