// An answer as JSON: keys are seam_t's field names, lengths in mm, angles in rad.
#pragma once

#include <arcstart/seam_t.hpp>
#include <nlohmann/json.hpp>

namespace arcstart::command_line {

// Verdicts and visibilities as words: "found", "not determined".
nlohmann::ordered_json seam_to_json(const seam_t& seam);

}  // namespace arcstart::command_line
