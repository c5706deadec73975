// Of transitions between two parallel plates: where each plate ends, and what joint that makes.
#pragma once

#include <array>
#include <optional>

#include "services/seam_finding/fit/line_fit.hpp"
#include "services/seam_finding/joints/transitions.hpp"

namespace arcstart::seam_finding {

// Plate 0 lies at the smaller `across` of the frame, plate 1 at the larger.
struct ParallelEdges {
  std::array<std::optional<LineFit>, 2> plates;  // where each ends, in its own plane
  std::array<std::optional<double>, 2> slants;   // of a cut that falls away: from the normal; rad
  double depth = 0;                              // down to which a cut was seen; mm
  // Of a narrow gap: both borders are told by all stripes together better than by any alone.
  bool together = false;
};

// Something stands before both plates, as a bead, a bar or a cable that hides their edges.
bool is_covered(const ScanCloud& cloud, const Transition& transition,
                const std::array<Plane, 2>& planes, double near_mm);

// Those of the transitions in which nothing does. planes, near_mm: as below.
std::vector<Transition> showing_edges(const ScanCloud& cloud,
                                      const std::vector<Transition>& transitions,
                                      const std::array<Plane, 2>& planes, double near_mm);

// planes: of the plates. near_mm: how far a point of a plate lies from its plane. pitch: between
// points of a stripe; mm.
ParallelEdges edges_of(const ScanCloud& cloud, const std::vector<Transition>& transitions,
                       const PlateFrame& frame, const std::array<Plane, 2>& planes, double near_mm,
                       double pitch_mm);

// Whether between the plates something is seen that lies below both.
bool sees_below(const ScanCloud& cloud, const Transition& transition,
                const std::array<Plane, 2>& planes, double near_mm);

}  // namespace arcstart::seam_finding
