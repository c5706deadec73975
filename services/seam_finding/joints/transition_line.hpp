// Transitions from one plate to another that lie on one straight line: what may be a seam.
#pragma once

#include <array>
#include <vector>

#include "services/seam_finding/joints/transitions.hpp"

namespace arcstart::seam_finding {

struct TransitionLine {
  PlateFrame frame;
  std::array<int, 2> faces{};           // at the smaller `across`, at the larger
  std::vector<Transition> transitions;  // on one line
  double share = 0;                     // of the sections that see both plates there
};

// In the frame, half-way between the two points; mm.
Eigen::Vector3d place_of(const ScanCloud& cloud, const PlateFrame& frame,
                         const Transition& transition);

// The transitions that lie together on the line which most sections support; one a section.
std::vector<Transition> on_one_line(const ScanCloud& cloud, const PlateFrame& frame,
                                    const std::vector<Transition>& transitions);

// Of the sections between the first and the last of the transitions, at least one: in how many one
// of them lies.
double share_of_sections(const ScanCloud& cloud, const std::vector<Section>& sections,
                         const std::vector<Transition>& transitions);

}  // namespace arcstart::seam_finding
