#include "services/seam_finding/joints/straight_runs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/model/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// Positions in a section, both included.
struct Run {
  std::size_t first = 0, last = 0;
};

// Where a point lies in the section's plane: across and out; mm.
struct Place {
  double across = 0, out = 0;
};

// Sums of places for a line out = level + slope * across through them.
struct LineSums {
  double n = 0, a = 0, o = 0, aa = 0, ao = 0, oo = 0;

  void add(const Place& p) {
    ++n, a += p.across, o += p.out;
    aa += p.across * p.across, ao += p.across * p.out, oo += p.out * p.out;
  }
  LineSums without(const LineSums& s) const {
    return {n - s.n, a - s.a, o - s.o, aa - s.aa, ao - s.ao, oo - s.oo};
  }
  double slope() const {
    const double spread = aa - a * a / n;
    return spread > 0 ? (ao - a * o / n) / spread : 0;
  }
  double off(const Place& p) const { return p.out - o / n - slope() * (p.across - a / n); }
  double squares() const { return oo - o * o / n - slope() * (ao - a * o / n); }
};

// The straight runs of one stretch of neighbours that lie on the face.
class Stretch {
 public:
  Stretch(std::vector<Place> places, double near_mm)
      : places_(std::move(places)), near_(near_mm), sums_(places_.size() + 1) {
    for (std::size_t i = 0; i < places_.size(); ++i)
      sums_[i + 1] = sums_[i], sums_[i + 1].add(places_[i]);
  }

  std::vector<Run> runs() {
    if (!places_.empty()) part(0, places_.size());
    return std::move(runs_);
  }

 private:
  // A stray point parts nothing, a step or a pit does.
  bool straight(std::size_t from, std::size_t to) const {
    const LineSums sums = sums_[to].without(sums_[from]);
    double before = 0;
    for (std::size_t i = from; i < to; ++i) {
      const double off = sums.off(places_[i]);
      if (std::abs(off) > 2 * near_) return false;
      if (std::abs(off) > near_ && std::abs(before) > near_ && off * before > 0) return false;
      before = off;
    }
    return true;
  }

  void part(std::size_t from, std::size_t to) {
    const auto least = static_cast<std::size_t>(kModel.sure_points);
    if (to - from < least) return;
    if (straight(from, to)) {
      if (std::abs(sums_[to].without(sums_[from]).slope()) <= kJoints.steepest_run)
        runs_.push_back({from, to - 1});
      return;
    }
    std::size_t at = from + 1;
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = from + 1; i < to; ++i) {
      const double left =
          sums_[i].without(sums_[from]).squares() + sums_[to].without(sums_[i]).squares();
      if (left < smallest) smallest = left, at = i;
    }
    part(from, at);
    part(at, to);
  }

  std::vector<Place> places_;
  double near_;
  std::vector<LineSums> sums_;  // of the places before each
  std::vector<Run> runs_;
};

// The runs of a section, in order.
std::vector<Run> runs_of(const ScanCloud& cloud, const Section& section, const PlateFrame& frame,
                         const std::vector<int>& face_of, int a, int b, double near_mm) {
  std::vector<Run> runs;
  const auto on_face = [&](std::size_t k) {
    return face_of[section[k]] == a || face_of[section[k]] == b;
  };
  const auto segment = [&](std::size_t k) { return cloud.origins[section[k]].segment; };
  // Where light ends, its last centre may be off.
  const auto ends = [&](std::size_t k) { return cloud.origins[section[k]].segment_end; };
  for (std::size_t begin = 0, end = 0; begin < section.size(); begin = end) {
    end = begin + 1;
    if (!on_face(begin)) continue;
    while (end < section.size() && on_face(end) && segment(end) == segment(begin)) ++end;
    std::size_t first = begin, last = end;
    if (ends(first)) ++first;
    if (last > first && ends(last - 1)) --last;
    std::vector<Place> places;
    for (std::size_t k = first; k < last; ++k) {
      const Eigen::Vector3d p = frame.of(cloud.points[section[k]]);
      places.push_back({p.y(), p.z()});
    }
    for (Run run : Stretch(std::move(places), near_mm).runs()) {
      run.first += first, run.last += first;
      if (run.first == first) run.first = begin;
      if (run.last == last - 1) run.last = end - 1;
      runs.push_back(run);
    }
  }
  return runs;
}

}  // namespace

std::vector<Transition> transitions_within(const ScanCloud& cloud,
                                           const std::vector<Section>& sections,
                                           const PlateFrame& frame, const std::vector<int>& face_of,
                                           int a, int b, double near_mm) {
  std::vector<Transition> transitions;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const Section& section = sections[k];
    const auto runs = runs_of(cloud, section, frame, face_of, a, b, near_mm);
    for (std::size_t r = 1; r < runs.size(); ++r) {
      Transition transition;
      transition.section = static_cast<int>(k);
      transition.last = section[runs[r - 1].last];
      transition.first = section[runs[r].first];
      for (std::size_t i = runs[r - 1].last + 1; i < runs[r].first; ++i)
        transition.between.push_back(section[i]);
      transitions.push_back(std::move(transition));
    }
  }
  return transitions;
}

}  // namespace arcstart::seam_finding
