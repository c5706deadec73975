#include "services/seam_finding/coverage/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "services/seam_finding/coverage/stations.hpp"
#include "services/seam_finding/visibility/occlusion.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr double kLoneGap = 2.5;    // stripe spacings
constexpr double kSamePlace = 0.3;  // of the spacing: the tool stood still

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
    } else if (stations[i].along - counted_at > kSamePlace * spacing) {
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
                const CourseSearch& search, const HiddenBetween& hidden) {
  const auto best =
      std::max_element(found.begin(), found.end(),
                       [](const Stretch& a, const Stretch& b) { return a.covered < b.covered; });
  Stretch whole = *best;
  const auto joins = [&](const Stretch& piece, int from, int to) {
    const double gap = stations[to].along - stations[from].along;
    return gap <= (piece.stripes < 2 ? kLoneGap * search.spacing : search.bridge) ||
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

Course course_of(const Stations& stations, const CourseSearch& search,
                 const HiddenBetween& hidden) {
  Course course;
  const auto found = stretches(stations, search.spacing);
  if (found.empty()) return course;
  const Stretch whole = longest(found, stations.list, search, hidden);
  course.stripes = whole.stripes;
  course.covered = whole.covered;
  course.begin =
      end_beyond(stations.list, whole.first, -1, course.missing_before, course.begins_outside);
  course.end = end_beyond(stations.list, whole.last, +1, course.missing_after, course.ends_outside);
  return course;
}

}  // namespace

CourseSearch course_search(const Scales& scales) {
  CourseSearch search;
  search.spacing = scales.spacing;
  search.tolerance = scales.tolerance;
  return search;
}

Course find_course(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                   const Line& line, const CourseSearch& search) {
  Stations stations = stations_along(cloud, plates, line, search);
  Course course = course_of(stations, search, [&](int from, int to) {
    return hidden_between(cloud, plates, line, stations, from, to, search.tolerance);
  });
  course.stations = std::move(stations);
  return course;
}

Course find_course(Stations stations, const CourseSearch& search) {
  Course course = course_of(stations, search, nullptr);
  course.stations = std::move(stations);
  return course;
}

double centroid_of_first(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                         const Line& line, const Course& course, int count) {
  std::vector<double> places;
  for (const JointPlate& plate : plates)
    for (const int i : plate.points) {
      const double t = line.along(cloud.points[i]);
      if (t >= course.begin && t <= course.end && line.distance(cloud.points[i]) <= plate.contact)
        places.push_back(t);
    }
  if (places.empty()) return course.begin;
  std::sort(places.begin(), places.end());
  places.resize(std::min(places.size(), static_cast<std::size_t>(count)));
  double sum = 0;
  for (const double t : places) sum += t;
  return sum / static_cast<double>(places.size());
}

}  // namespace arcstart::seam_finding
