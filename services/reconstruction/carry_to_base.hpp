// Eq. 1: from the stripe's pixels through the camera and the tool to the robot's base.
#pragma once

#include <vector>

#include "common/calibration.hpp"
#include "services/reconstruction/stripe.hpp"

namespace arcstart::reconstruction {

// Depth along the optical axis within which the sensor measures; mm.
struct WorkingRange {
  double nearest, farthest;
};

// p_base = T_base_tool * T_tool_camera * p_camera for each centre. Dropped are centres whose ray
// does not meet the laser plane in front of the camera, and points outside the range.
std::vector<ProfilePoint> carry_to_base(const std::vector<ReceivedCentre>& centres,
                                        const Calibration& calibration,
                                        const RigidTransform& T_base_tool,
                                        const WorkingRange& range);

}  // namespace arcstart::reconstruction
