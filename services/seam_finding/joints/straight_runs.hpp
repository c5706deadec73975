// Within one face: where a stripe leaves one straight surface for another. Two plates side by side
// at nearly one level, or bent ones, are laid out as one face, whose plane then lies between them
// and tells of neither.
#pragma once

#include <vector>

#include "services/seam_finding/joints/transitions.hpp"

namespace arcstart::seam_finding {

// A plate shows in a stripe as a straight run of points, whatever the face's plane is. Transitions
// between one run and the next of a section, with what lies between. The face's points that are off
// every run by more than `near_mm` are between. a, b: indices of faces that lie in one plane, or
// one face twice.
std::vector<Transition> transitions_within(const ScanCloud& cloud,
                                           const std::vector<Section>& sections,
                                           const PlateFrame& frame, const std::vector<int>& face_of,
                                           int a, int b, double near_mm);

}  // namespace arcstart::seam_finding
