#include "services/seam_finding/model/joint_type.hpp"

namespace arcstart::seam_finding {

std::string name_of(JointType type) {
  switch (type) {
    case JointType::kTee:
      return "tee";
    case JointType::kCorner:
      return "corner";
    case JointType::kOutsideCorner:
      return "outside_corner";
    case JointType::kLap:
      return "lap";
    case JointType::kButt:
      return "butt";
    case JointType::kV:
      return "v";
  }
  return "";
}

std::vector<JointType> wanted_types(const std::string& setting) {
  if (setting == "any") return {JointType::kTee, JointType::kLap, JointType::kButt, JointType::kV};
  for (const JointType type : {JointType::kCorner, JointType::kOutsideCorner, JointType::kLap,
                               JointType::kButt, JointType::kV})
    if (setting == name_of(type)) return {type};
  return {JointType::kTee};
}

}  // namespace arcstart::seam_finding
