#include "services/seam_finding/joints/transitions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/order_statistics.hpp"
#include "services/seam_finding/fit/line_fit.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// A stripe's segments come in the image's order; across the search they are put in theirs.
Section in_order(const ScanCloud& cloud, const ScanStripe& stripe, const PlateFrame& frame) {
  struct Piece {
    int first = 0, last = 0;
    double middle = 0;
  };
  std::vector<Piece> pieces;
  for (int i = stripe.first; i < stripe.first + stripe.count; ++i) {
    if (i == stripe.first || cloud.origins[i].segment != cloud.origins[i - 1].segment)
      pieces.push_back({i, i});
    pieces.back().last = i;
  }
  const auto across = [&](int i) { return frame.across.dot(cloud.points[i]); };
  for (Piece& piece : pieces) piece.middle = (across(piece.first) + across(piece.last)) / 2;
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.middle < b.middle; });
  Section section;
  for (const Piece& piece : pieces) {
    const bool turned = across(piece.first) > across(piece.last);
    for (int i = 0; i <= piece.last - piece.first; ++i)
      section.push_back(turned ? piece.last - i : piece.first + i);
  }
  return section;
}

// How far a section's points on a face lie from its plane, half of them; mm.
double level_of(const ScanCloud& cloud, const Section& section, const std::vector<int>& face_of,
                const std::vector<Face>& faces, int face) {
  std::vector<double> off;
  for (const int i : section)
    if (face_of[i] == face && !cloud.origins[i].segment_end)
      off.push_back(faces[face].plane.signed_distance(cloud.points[i]));
  return std::ssize(off) < kModel.sure_points ? 0 : median(off);
}

}  // namespace

std::vector<Section> sections_across(const ScanCloud& cloud, const PlateFrame& frame,
                                     double spacing_mm) {
  std::vector<Section> sections;
  if (cloud.organised()) {
    for (const ScanStripe& stripe : cloud.stripes)
      sections.push_back(in_order(cloud, stripe, frame));
    return sections;
  }
  std::map<int, Section> slices;
  for (int i = 0; i < cloud.size(); ++i)
    slices[static_cast<int>(std::floor(frame.of(cloud.points[i]).x() / spacing_mm))].push_back(i);
  for (auto& [slice, points] : slices) {
    std::stable_sort(points.begin(), points.end(), [&](int a, int b) {
      return frame.across.dot(cloud.points[a]) < frame.across.dot(cloud.points[b]);
    });
    sections.push_back(std::move(points));
  }
  return sections;
}

std::vector<Transition> transitions_between(const ScanCloud& cloud,
                                            const std::vector<Section>& sections,
                                            const std::vector<int>& face_of,
                                            const std::vector<Face>& faces, int a, int b,
                                            double near_mm) {
  std::vector<Transition> transitions;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    // Bent plates leave their planes along the seam; one face that holds both plates has one level.
    const bool two = a != b;
    const double level_a = two ? level_of(cloud, sections[k], face_of, faces, a) : 0,
                 level_b = two ? level_of(cloud, sections[k], face_of, faces, b) : 0;
    const auto on_plate = [&](int i) {
      const int face = face_of[i];
      return (face == a || face == b) &&
             (cloud.origins[i].segment_end ||
              std::abs(faces[face].plane.signed_distance(cloud.points[i]) -
                       (face == a ? level_a : level_b)) <= near_mm);
    };
    int last = -1;
    std::vector<int> between;
    for (const int i : sections[k]) {
      if (!on_plate(i)) {
        between.push_back(i);
        continue;
      }
      const bool parted = !between.empty() ||
                          (last >= 0 && cloud.origins[last].segment != cloud.origins[i].segment);
      if (last >= 0 && (a == b ? parted : face_of[last] != face_of[i]))
        transitions.push_back(
            {static_cast<int>(k), last, i, std::move(between), face_of[last] == a});
      between.clear();
      last = i;
    }
  }
  return transitions;
}

Eigen::Vector3d place_of(const ScanCloud& cloud, const PlateFrame& frame,
                         const Transition& transition) {
  return frame.of((cloud.points[transition.last] + cloud.points[transition.first]) / 2);
}

std::vector<Transition> on_one_line(const ScanCloud& cloud, const PlateFrame& frame,
                                    const std::vector<Transition>& transitions) {
  std::vector<Eigen::Vector3d> places;
  for (const Transition& transition : transitions)
    places.push_back(place_of(cloud, frame, transition));
  const std::size_t stride = 1 + transitions.size() / kJoints.drawn;
  double most = 0;
  std::vector<Transition> best;
  for (std::size_t a = 0; a < places.size(); a += stride)
    for (std::size_t b = a + stride; b < places.size(); b += stride) {
      if (transitions[a].covered || transitions[b].covered) continue;
      const double base = places[b].x() - places[a].x();
      const double slope = (places[b].y() - places[a].y()) / base;
      if (std::abs(base) < kJoints.least_base || std::abs(slope) > kJoints.steepest_line) continue;
      std::set<int> sections;
      std::vector<Transition> chosen;
      double support = 0;  // what lies on the line counts twice what lies at its band's border
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double off = places[i].y() - places[a].y() - slope * (places[i].x() - places[a].x());
        if (std::abs(off) > kJoints.on_line || !sections.insert(transitions[i].section).second)
          continue;
        chosen.push_back(transitions[i]);
        if (!transitions[i].covered) support += 2 - std::abs(off) / kJoints.on_line;
      }
      if (support > most) most = support, best = std::move(chosen);
    }
  return best;
}

double share_of_sections(const ScanCloud& cloud, const std::vector<Section>& sections,
                         const std::vector<int>& face_of, const TransitionLine& candidate) {
  const PlateFrame& frame = candidate.frame;
  std::vector<LinePlace> places;
  int first = candidate.transitions.front().section, last = first, known = 0;
  for (const Transition& transition : candidate.transitions) {
    first = std::min(first, transition.section), last = std::max(last, transition.section);
    const Eigen::Vector3d p = place_of(cloud, frame, transition);
    places.push_back({p.x(), p.y(), 0, 1});
  }
  const auto line = fit_line(places, 1);
  for (int k = first; line && k <= last; ++k) {
    std::array<bool, 2> seen{};
    for (const int i : sections[k]) {
      const Eigen::Vector3d p = frame.of(cloud.points[i]);
      const double off = p.y() - line->across_at(p.x());
      const int side = off > 0;
      if (std::abs(off) < kJoints.full_reach && face_of[i] == candidate.faces[side])
        seen[side] = true;
    }
    known += seen[0] && seen[1];
  }
  return std::min(1.0, static_cast<double>(candidate.transitions.size()) / std::max(1, known));
}

}  // namespace arcstart::seam_finding
