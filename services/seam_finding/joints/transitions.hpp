// Where a scan goes over from one plate to another in the same or a parallel plane.
#pragma once

#include <array>
#include <vector>

#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// Axes in a plate: along the search, across it, and out of the metal; an origin on the plate.
struct PlateFrame {
  Eigen::Vector3d origin, along, across, normal;

  // (along, across, out) of a point; mm
  Eigen::Vector3d of(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d p = point - origin;
    return {along.dot(p), across.dot(p), normal.dot(p)};
  }
};

// The points of a stripe, or without stripes of a slice as wide as the points' spacing, in their
// order across the search.
using Section = std::vector<int>;
std::vector<Section> sections_across(const ScanCloud& cloud, const PlateFrame& frame,
                                     double spacing_mm);

// In a section two neighbours on plates, with what lies between them.
struct Transition {
  int section = 0;
  int last = 0, first = 0;   // indices of the points: the one with the smaller `across`, the other
  std::vector<int> between;  // on neither plate, in order
  bool rising = true;        // from the first face to the second, or back
  bool covered = false;      // something stands before both plates there: their edges do not show
};

// Between a point of face a and one of face b. Where both are one face: between two of its points
// that lie in different segments or with something between. A point is on its face where it is no
// farther from it than `near_mm`, a segment's end wherever the face holds it; of two faces, from
// where most of the section's points on it lie. faces: of each point, the index of its face, -1 for
// none.
std::vector<Transition> transitions_between(const ScanCloud& cloud,
                                            const std::vector<Section>& sections,
                                            const std::vector<int>& face_of,
                                            const std::vector<Face>& faces, int a, int b,
                                            double near_mm);

// Transitions from one plate to another that lie on one straight line: what may be a seam.
struct TransitionLine {
  PlateFrame frame;
  std::array<int, 2> faces{};           // at the smaller `across`, at the larger
  std::vector<Transition> transitions;  // on one line
  double share = 0;                     // of the sections that see both plates there
  bool by_runs = false;                 // the transitions are those of transitions_within()
};

// In the frame, half-way between the two points; mm.
Eigen::Vector3d place_of(const ScanCloud& cloud, const PlateFrame& frame,
                         const Transition& transition);

// The transitions that lie together on the line which most sections support, the nearer to it the
// more, and where edges show alone; one a section.
std::vector<Transition> on_one_line(const ScanCloud& cloud, const PlateFrame& frame,
                                    const std::vector<Transition>& transitions);

// Of the sections between the first and the last of the transitions, at least one, that see both
// plates beside the line: in how many a transition lies. A bar across the seam hides them.
double share_of_sections(const ScanCloud& cloud, const std::vector<Section>& sections,
                         const std::vector<int>& face_of, const TransitionLine& candidate);

}  // namespace arcstart::seam_finding
