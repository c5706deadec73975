// How far an answer lies from the truth, in the design's sense.
#pragma once

#include <arcstart/seam_t.hpp>
#include <arcstart/truth_t.hpp>
#include <string>

namespace arcstart::command_line {

struct SeamError {
  double start_mm;       // |answer - true start|
  double along_mm;       // its part along the true direction
  double lateral_mm;     // the rest
  double direction_deg;  // 0 to 180: a reversed seam is wrong
  bool wrong;  // lateral over 5 mm, direction over 5 deg, another type, or nearer to the true end
};

// Of a FOUND seam.
SeamError seam_error(const seam_t& seam, const truth_t& truth);

// "seam found: start error X mm, lateral Y mm, direction Z deg", or "no seam: REASON".
std::string verdict_line(const seam_t& seam, const truth_t& truth);

}  // namespace arcstart::command_line
