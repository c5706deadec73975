// Whether any hand-eye fits the robot's poses, and where none does which of the usual slips in them
// explains it: another convention, another unit, another pairing of poses and images.
#pragma once

#include <string>
#include <vector>

#include "services/calibration/stages/pose_readings.hpp"
#include "services/calibration/target/target.hpp"

namespace arcstart::calibration {

// What is to be said where no hand-eye fits the poses as they stand: as what they fit and what
// cures it, or that nothing explains them. Empty where one fits, or where fewer than five poses
// show the plate. A few wrong poses change nothing.
std::string pose_slip(const Target& plate, const std::vector<PairedPose>& poses);

}  // namespace arcstart::calibration
