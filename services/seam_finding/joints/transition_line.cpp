#include "services/seam_finding/joints/transition_line.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace arcstart::seam_finding {
namespace {

constexpr double kOnLine = 2;        // a passage from its line; mm
constexpr double kLeastBase = 10;    // between the passages that draw a line; mm
constexpr double kSteepest = 0.8;    // of it, mm across for each mm along
constexpr std::size_t kDrawn = 200;  // passages that may draw one

}  // namespace

Eigen::Vector3d place_of(const ScanCloud& cloud, const PlateFrame& frame, const Passage& passage) {
  return frame.of((cloud.points[passage.last] + cloud.points[passage.first]) / 2);
}

std::vector<Passage> on_one_line(const ScanCloud& cloud, const PlateFrame& frame,
                                 const std::vector<Passage>& passages) {
  std::vector<Eigen::Vector3d> places;
  for (const Passage& passage : passages) places.push_back(place_of(cloud, frame, passage));
  const std::size_t stride = 1 + passages.size() / kDrawn;
  std::size_t most = 0;
  std::vector<Passage> best;
  for (std::size_t a = 0; a < places.size(); a += stride)
    for (std::size_t b = a + stride; b < places.size(); b += stride) {
      const double base = places[b].x() - places[a].x();
      const double slope = (places[b].y() - places[a].y()) / base;
      if (std::abs(base) < kLeastBase || std::abs(slope) > kSteepest) continue;
      std::set<int> sections;
      std::vector<Passage> chosen;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double off = places[i].y() - places[a].y() - slope * (places[i].x() - places[a].x());
        if (std::abs(off) <= kOnLine && sections.insert(passages[i].section).second)
          chosen.push_back(passages[i]);
      }
      if (chosen.size() > most) most = chosen.size(), best = std::move(chosen);
    }
  return best;
}

double share_of_sections(const ScanCloud& cloud, const std::vector<Section>& sections,
                         const std::vector<Passage>& passages) {
  int first = passages.front().section, last = first, known = 0;
  for (const Passage& passage : passages)
    first = std::min(first, passage.section), last = std::max(last, passage.section);
  for (int k = first; k <= last; ++k)
    known += !cloud.organised() || cloud.stripes[k].seen != ScanStripe::Seen::kMissing
                 ? !sections[k].empty()
                 : 0;
  return static_cast<double>(passages.size()) / std::max(1, known);
}

}  // namespace arcstart::seam_finding
