// One least-squares adjustment of everything: camera, distortion, laser plane, hand-eye, the
// plate's place, and where the robot truly was in each pose. The robot's deviation from what it
// says is held by a prior, whose size the data themselves tell.
#pragma once

#include <vector>

#include "services/calibration/adjustment/adjustment_model.hpp"
#include "services/calibration/target/target.hpp"
#include "services/calibration/target/view.hpp"

namespace arcstart::calibration {

// Robust in the image and in the robot. Needs at least three views; a view without a stripe adds
// none to the laser plane.
Adjustment adjust(const Target& plate, const std::vector<View>& views, const AdjustmentState& start,
                  const Deviations& deviations, const AdjustmentOptions& options);

}  // namespace arcstart::calibration
