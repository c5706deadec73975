#include "services/seam_finding/coverage/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "services/seam_finding/coverage/constants.hpp"
#include "services/seam_finding/coverage/stations.hpp"
#include "services/seam_finding/visibility/occlusion.hpp"

namespace arcstart::seam_finding {
namespace {

// An uninterrupted part of the seam.
struct Stretch {
  int first = 0, last = 0;  // stations, both with both plates
  int stripes = 0;
  double covered = 0;  // mm
};

std::vector<Stretch> stretches(const Stations& all, double spacing) {
  const std::vector<Station>& stations = all.list;
  std::vector<Stretch> found;
  bool open = false;
  double counted_at = 0;
  for (int i = 0; i < static_cast<int>(stations.size()); ++i) {
    if (!stations[i].known) continue;
    if (!all.both(stations[i])) {
      open = false;
      continue;
    }
    if (!open) {
      found.push_back({i, i, 1, spacing});
      counted_at = stations[i].along;
    } else if (stations[i].along - counted_at > kCoverage.same_place * spacing) {
      found.back().covered += stations[i].along - counted_at;
      ++found.back().stripes;
      counted_at = stations[i].along;
    }
    found.back().last = i;
    open = true;
  }
  return found;
}

// Of the stations between two of them.
using HiddenBetween = std::function<bool(int, int)>;

// The longest, and what lies beyond short interruptions of it, or such where it is hidden. A lone
// stripe is part of the seam only where no more than one stripe lies between.
Stretch longest(const std::vector<Stretch>& found, const std::vector<Station>& stations,
                const Scales& scales, const HiddenBetween& hidden) {
  const auto best =
      std::max_element(found.begin(), found.end(),
                       [](const Stretch& a, const Stretch& b) { return a.covered < b.covered; });
  Stretch whole = *best;
  const auto joins = [&](const Stretch& piece, int from, int to) {
    const double gap = stations[to].along - stations[from].along;
    return gap <= (piece.stripes < 2 ? kCoverage.lone_gap * scales.spacing : kCoverage.bridge) ||
           (hidden && hidden(from, to));
  };
  const auto take = [&](const Stretch& piece) {
    whole.first = std::min(whole.first, piece.first);
    whole.last = std::max(whole.last, piece.last);
    whole.stripes += piece.stripes;
    whole.covered += piece.covered;
  };
  for (auto piece = best; piece != found.begin();) {
    --piece;
    if (!joins(*piece, piece->last, whole.first)) break;
    take(*piece);
  }
  for (auto piece = best + 1; piece != found.end(); ++piece) {
    if (!joins(*piece, whole.last, piece->first)) break;
    take(*piece);
  }
  return whole;
}

double end_beyond(const std::vector<Station>& stations, int from, int step, int& missing,
                  bool& outside) {
  missing = 0;
  for (int i = from + step; i >= 0 && i < static_cast<int>(stations.size()); i += step) {
    if (stations[i].known) return (stations[i].along + stations[from].along) / 2;
    ++missing;
  }
  outside = true;
  return stations[from].along;
}

Coverage coverage_of(const Stations& stations, const Scales& scales, const HiddenBetween& hidden) {
  Coverage course;
  const auto found = stretches(stations, scales.spacing);
  if (found.empty()) return course;
  const Stretch whole = longest(found, stations.list, scales, hidden);
  course.stripes = whole.stripes;
  course.covered = whole.covered;
  course.begin =
      end_beyond(stations.list, whole.first, -1, course.missing_before, course.begins_outside);
  course.end = end_beyond(stations.list, whole.last, +1, course.missing_after, course.ends_outside);
  return course;
}

}  // namespace

Coverage find_coverage(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                       const Line& line, const Scales& scales) {
  Stations stations = stations_along(cloud, plates, line, scales);
  Coverage course = coverage_of(stations, scales, [&](int from, int to) {
    return occluded_between(cloud, plates, line, stations, from, to, scales.tolerance);
  });
  course.stations = std::move(stations);
  return course;
}

Coverage find_coverage(Stations stations, const Scales& scales) {
  Coverage course = coverage_of(stations, scales, nullptr);
  course.stations = std::move(stations);
  return course;
}

}  // namespace arcstart::seam_finding
