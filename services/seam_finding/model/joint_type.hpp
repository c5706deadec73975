// The kinds of joint between two plates.
#pragma once

#include <string>
#include <vector>

namespace arcstart::seam_finding {

enum class JointType {
  kTee,            // a plate stands on the other: fillet
  kCorner,         // two plates meet edge to edge, seen from inside; looks like a tee
  kOutsideCorner,  // the same, seen from outside; looks like the edge of a box
  kLap,            // a plate lies on the other
  kButt,           // side by side, edges square
  kV               // side by side, edges slanting
};

// As in seam_t.
std::string name_of(JointType type);

// What the setting `joint_type` asks for: the one it names; `any`: tee, lap, butt and v.
std::vector<JointType> wanted_types(const std::string& setting);

inline bool is_parallel(JointType type) {
  return type == JointType::kLap || type == JointType::kButt || type == JointType::kV;
}

}  // namespace arcstart::seam_finding
