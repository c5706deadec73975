// Whether the poses can tell what is sought, and what would make them tell it better.
#pragma once

#include <string>
#include <vector>

#include "common/geometry.hpp"

namespace arcstart::calibration {

struct PoseDiversity {
  int views = 0;
  double tilt_deg = 0;      // of the plate from square to the optical axis, at most
  double rotation_deg = 0;  // between two views, at most
  // Least over greatest singular value of the stacked R - I between views: 0 where all turns share
  // an axis, along which the hand-eye's place cannot be seen.
  double axis_ratio = 0;
  double nearest_mm = 0, farthest_mm = 0;  // the plate along the optical axis
  double roll_deg = 0;                     // about the optical axis, between two views, at most
  int tilted_towards = 0;                  // of four directions, how many the plate was tilted to
};

PoseDiversity pose_diversity(const std::vector<RigidTransform>& T_camera_plate);

// Why no calibration can come of the poses, and what is missing; empty where one can.
std::string diversity_refusal(const PoseDiversity& spread);

// Too few or too alike views to tell camera and hand-eye apart: the camera is then held as the
// camera stage found it.
bool camera_must_be_held(const PoseDiversity& spread);

// What further poses would add most, best first, for people.
std::vector<std::string> diversity_advice(const PoseDiversity& spread);

}  // namespace arcstart::calibration
