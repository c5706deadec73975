// Of passages between two parallel plates: where each plate ends, and what joint that makes.
#pragma once

#include <array>
#include <optional>

#include "services/seam_finding/fit/line_fit.hpp"
#include "services/seam_finding/joints/transitions.hpp"

namespace arcstart::seam_finding {

// Plate 0 lies at the smaller `across` of the frame, plate 1 at the larger.
struct FlatBorders {
  std::array<std::optional<BorderFit>, 2> plates;  // where each ends, in its own plane
  std::array<std::optional<double>, 2> slants;     // of a cut that falls away: from the normal; rad
  // Of a narrow gap: both borders are told by all stripes together better than by any alone.
  bool together = false;
};

// planes: of the plates. near_mm: how far a point of a plate lies from its plane. pitch: between
// points of a stripe; mm.
FlatBorders borders_of(const ScanCloud& cloud, const std::vector<Passage>& passages,
                       const PlateFrame& frame, const std::array<Plane, 2>& planes, double near_mm,
                       double pitch_mm);

// Of a lap: the foot of the upper plate's cut on the lower plate, or where the cut was not seen the
// upper plate's end, brought down along the normal. In the lower plate's plane.
struct LapFoot {
  BorderFit fit;
  bool seen = false;
};
std::optional<LapFoot> lap_foot(const ScanCloud& cloud, const std::vector<Passage>& passages,
                                const PlateFrame& frame, const std::array<Plane, 2>& planes,
                                int upper, double step_mm, double near_mm, double pitch_mm);

}  // namespace arcstart::seam_finding
