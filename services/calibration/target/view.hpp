// What one pose of the robot contributes to a calibration.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/geometry.hpp"

namespace arcstart::calibration {

struct View {
  int index = 0;               // of the pose, for people
  RigidTransform T_base_tool;  // as the robot says
  // Distorted pixels. The plate's points in its order, or none; the stripe's centres, or none.
  std::vector<Eigen::Vector2d> target, stripe;
  std::string unusable;  // why the view cannot be used, empty where it can
};

}  // namespace arcstart::calibration
