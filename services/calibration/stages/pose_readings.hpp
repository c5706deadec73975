// What a set's poses may have meant instead of what they say.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry.hpp"

namespace arcstart::calibration {

// Of each pose of a set, in its order; those included whose image shows no plate.
struct PairedPose {
  RigidTransform T_base_tool = RigidTransform::Identity();  // as the robot says
  std::optional<RigidTransform> T_camera_plate;             // as the image shows it
};

struct PoseReading {
  std::string what;  // "they fit with " what
  std::string cure;
  std::function<std::vector<PairedPose>(const std::vector<PairedPose>&)> read;
  bool inverts = false;  // base in tool, as which eye-to-hand sets look, too
};

// The usual slips, likelier ones first: of readings that come to the same the first is meant. The
// first of all changes nothing: length units and mirrors show by the moves' lengths.
const std::vector<PoseReading>& pose_readings();

}  // namespace arcstart::calibration
