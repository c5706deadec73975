// The answers of a replay as a file, so that two builds can be compared byte by byte.
#pragma once

#include <string>
#include <vector>

#include "services/command_line/recordings/replay.hpp"

namespace arcstart::command_line {

// Of each seam, in order, the length of its encoded seam_t (4 bytes, little-endian) and its bytes.
// Throws InputError where the file cannot be written in whole.
void write_answers(const std::string& path, const std::vector<ReplayedSeam>& seams);

}  // namespace arcstart::command_line
