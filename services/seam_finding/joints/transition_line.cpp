#include "services/seam_finding/joints/transition_line.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace arcstart::seam_finding {
namespace {

constexpr double kOnLine = 2;        // a transition from its line; mm
constexpr double kLeastBase = 10;    // between the transitions that draw a line; mm
constexpr double kSteepest = 0.8;    // of it, mm across for each mm along
constexpr std::size_t kDrawn = 200;  // transitions that may draw one

}  // namespace

Eigen::Vector3d place_of(const ScanCloud& cloud, const PlateFrame& frame,
                         const Transition& transition) {
  return frame.of((cloud.points[transition.last] + cloud.points[transition.first]) / 2);
}

std::vector<Transition> on_one_line(const ScanCloud& cloud, const PlateFrame& frame,
                                    const std::vector<Transition>& transitions) {
  std::vector<Eigen::Vector3d> places;
  for (const Transition& transition : transitions)
    places.push_back(place_of(cloud, frame, transition));
  const std::size_t stride = 1 + transitions.size() / kDrawn;
  std::size_t most = 0;
  std::vector<Transition> best;
  for (std::size_t a = 0; a < places.size(); a += stride)
    for (std::size_t b = a + stride; b < places.size(); b += stride) {
      const double base = places[b].x() - places[a].x();
      const double slope = (places[b].y() - places[a].y()) / base;
      if (std::abs(base) < kLeastBase || std::abs(slope) > kSteepest) continue;
      std::set<int> sections;
      std::vector<Transition> chosen;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double off = places[i].y() - places[a].y() - slope * (places[i].x() - places[a].x());
        if (std::abs(off) <= kOnLine && sections.insert(transitions[i].section).second)
          chosen.push_back(transitions[i]);
      }
      if (chosen.size() > most) most = chosen.size(), best = std::move(chosen);
    }
  return best;
}

double share_of_sections(const ScanCloud& cloud, const std::vector<Section>& sections,
                         const std::vector<Transition>& transitions) {
  int first = transitions.front().section, last = first, known = 0;
  for (const Transition& transition : transitions)
    first = std::min(first, transition.section), last = std::max(last, transition.section);
  for (int k = first; k <= last; ++k)
    known += !cloud.organised() || cloud.stripes[k].seen != ScanStripe::Seen::kMissing
                 ? !sections[k].empty()
                 : 0;
  return static_cast<double>(transitions.size()) / std::max(1, known);
}

}  // namespace arcstart::seam_finding
