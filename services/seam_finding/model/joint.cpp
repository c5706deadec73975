#include "services/seam_finding/model/joint.hpp"

namespace arcstart::seam_finding {

double open_angle(const Joint& joint) {
  const double fold = angle_between(joint.plates[0].plane.normal, joint.plates[1].plane.normal);
  return joint.type == JointType::kOutsideCorner ? M_PI + fold : M_PI - fold;
}

}  // namespace arcstart::seam_finding
