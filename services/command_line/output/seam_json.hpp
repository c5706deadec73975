// An answer as JSON: keys are seam_t's field names, lengths in mm, angles in rad.
#pragma once

#include <arcstart/seam_t.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace arcstart::command_line {

// Verdicts and visibilities as words: "found", "not determined".
nlohmann::ordered_json seam_to_json(const seam_t& seam);
// Its text, on one line or indented. Who only prints it need not compile nlohmann's headers.
std::string seam_to_json_line(const seam_t& seam);
std::string seam_to_json_text(const seam_t& seam);

}  // namespace arcstart::command_line
