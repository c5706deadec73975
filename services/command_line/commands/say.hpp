// What a command tells the person at the console.
#pragma once

#include <iostream>
#include <string>

namespace arcstart::command_line {

// A line on standard error, led by the command's name.
inline void say(const std::string& command, const std::string& text) {
  std::cerr << command << ": " << text << "\n";
}

}  // namespace arcstart::command_line
