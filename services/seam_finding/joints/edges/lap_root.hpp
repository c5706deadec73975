// The root of a lap: where the upper plate's cut meets the lower plate.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "services/seam_finding/fit/line_fit.hpp"
#include "services/seam_finding/joints/transitions.hpp"

namespace arcstart::seam_finding {

// Of a lap: the foot of the upper plate's cut on the lower plate, or where the cut was not seen the
// upper plate's end, brought down along the normal. In the lower plate's plane.
struct LapRoot {
  LineFit fit;
  bool seen = false;        // of the cut
  bool faces_away = false;  // from the camera
};
// planes: of the plates. step_mm: the upper plate's top over the lower one's. near_mm: how far a
// point of a plate lies from its plane. pitch_mm: between points of a stripe. Nothing where no line
// fits.
std::optional<LapRoot> lap_root(const ScanCloud& cloud, const std::vector<Transition>& transitions,
                                const PlateFrame& frame, const std::array<Plane, 2>& planes,
                                int upper, double step_mm, double near_mm, double pitch_mm);

}  // namespace arcstart::seam_finding
