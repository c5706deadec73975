// What a person sees while long work runs: one line of progress, on a terminal alone.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>

namespace arcstart::command_line {

// Rewrites its line on standard error; says nothing where that is no terminal.
class ProgressLine {
 public:
  ~ProgressLine() { clear(); }
  void show(const std::string& text) {
    if (!is_terminal_ || text == shown_) return;
    std::fprintf(stderr, "\r\033[K%s", text.c_str());
    std::fflush(stderr);
    shown_ = text;
  }
  void clear() { show(""); }

 private:
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  std::string shown_;
};

}  // namespace arcstart::command_line
