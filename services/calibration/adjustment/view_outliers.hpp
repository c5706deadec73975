// Views that do not belong to the others, one at a time, worst first.
#pragma once

#include <optional>
#include <vector>

#include "services/calibration/adjustment/adjustment.hpp"

namespace arcstart::calibration {

// A view whose grid fits the camera far worse than the others'. view_rms: px.
std::optional<std::size_t> odd_image(const std::vector<double>& view_rms);

// A view whose robot turned by other angles than its camera. disagreement: rad.
std::optional<std::size_t> odd_turn(const std::vector<double>& disagreement);

// A view whose stripe lies far farther from the laser plane than the others'. laser_rms_mm: 0
// without a stripe.
std::optional<std::size_t> odd_stripe(const std::vector<double>& laser_rms_mm);

// A view whose robot stood elsewhere than the others say it stood: its correction, in standard
// deviations that it had no part in, is one of chance once in a thousand sets.
std::optional<std::size_t> odd_pose(const Adjustment& adjustment);

}  // namespace arcstart::calibration
