#include "services/command_line/cell/check_line.hpp"

#include <fmt/core.h>

namespace arcstart::command_line {

std::string to_text(const std::vector<CheckLine>& lines, bool in_colour) {
  std::string text;
  for (const CheckLine& line : lines) {
    const bool good = line.mended_by.empty();
    const std::string state =
        fmt::format("{}{:<6}{}", in_colour ? (good ? "\033[32m" : "\033[31m") : "",
                    good ? "good" : "MEND", in_colour ? "\033[0m" : "");
    text += fmt::format("{}{:<12}{}\n", state, line.what, line.words);
    if (!good) text += fmt::format("{:18}-> {}\n", "", line.mended_by);
  }
  return text;
}

}  // namespace arcstart::command_line
