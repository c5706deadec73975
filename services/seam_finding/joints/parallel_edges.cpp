#include "services/seam_finding/joints/parallel_edges.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "services/seam_finding/gaps/butt_gap.hpp"
#include "services/seam_finding/joints/constants.hpp"
#include "services/seam_finding/joints/edges/plate_end_place.hpp"

namespace arcstart::seam_finding {
namespace {

// The points that follow on a plate's last one in the same segment, outward, as long as they fall
// as a cut does: what is flatter lies below the gap.
std::vector<int> falling(const ScanCloud& cloud, const Transition& transition,
                         const PlateFrame& frame, const Plane& plane, int plate, double near_mm) {
  std::vector<int> run;
  int before = last_on_plate(transition, plate);
  double height = plane.signed_distance(cloud.points[before]);
  const auto take = [&](int i) {
    const double h = plane.signed_distance(cloud.points[i]);
    if (cloud.organised() && cloud.origins[i].segment != cloud.origins[before].segment)
      return false;
    const double across = std::abs(frame.across.dot(cloud.points[i] - cloud.points[before]));
    const bool flat = height - h < std::tan(kJoints.least_top_fold) * across - near_mm;
    if (h > height || (flat && !run.empty())) return false;
    run.push_back(i), before = i, height = h;
    return true;
  };
  if (plate == 0) {
    for (auto i = transition.between.begin(); i != transition.between.end() && take(*i); ++i) {
    }
  } else {
    for (auto i = transition.between.rbegin(); i != transition.between.rend() && take(*i); ++i) {
    }
  }
  return run;
}

// Where the light ends at the other plate's edge and goes on down on this one's cut, seen past that
// edge: the end of the piece that leads up to this plate; -1 where it is not so.
int end_on_cut(const ScanCloud& cloud, const Transition& transition, const Plane& plane, int plate,
               double near_mm) {
  const int own = last_on_plate(transition, plate), other = last_on_plate(transition, 1 - plate);
  if (!cloud.organised() || transition.between.empty()) return -1;
  const int end = plate == 0 ? transition.between.back() : transition.between.front();
  const PointOrigin& origin = cloud.origins[end];
  const bool parted = cloud.origins[other].segment_end && origin.segment_end &&
                      origin.segment == cloud.origins[own].segment &&
                      origin.segment != cloud.origins[other].segment;
  return parted && plane.signed_distance(cloud.points[end]) < -near_mm ? end : -1;
}

// By how much the second plate's top lies above the first's, at a transition; mm.
double step_at(const ScanCloud& cloud, const Transition& transition,
               const std::array<Plane, 2>& planes) {
  const Eigen::Vector3d p = (cloud.points[transition.last] + cloud.points[transition.first]) / 2;
  return planes[0].signed_distance(p) - planes[1].signed_distance(p);
}

// Where the tops differ, the higher plate's edge shades and hides the lower one beside it: that
// plate ends anywhere from where it was last seen to the higher one's edge, but no farther than a
// shadow reaches. Nothing is hidden where something below it is seen between. In the middle of that
// stretch the lower plate's end is put. Returns, by plate, how long the stretch is on the average.
std::array<double, 2> beside_a_step(const ScanCloud& cloud,
                                    const std::vector<Transition>& transitions,
                                    const PlateFrame& frame, const std::array<Plane, 2>& planes,
                                    double near_mm, std::array<std::vector<LinePlace>, 2>& ends) {
  std::array<double, 2> hidden{};
  for (std::size_t k = 0; k < transitions.size(); ++k) {
    const double step = step_at(cloud, transitions[k], planes);
    if (std::abs(step) < 2 * near_mm || sees_below(cloud, transitions[k], planes, near_mm))
      continue;
    const int lower = step > 0 ? 0 : 1;
    const double most = kJoints.step_shadow * std::abs(step);
    const double stretch = std::clamp(ends[1][k].across - ends[0][k].across, 0.0, most);
    ends[lower][k].across += (lower == 0 ? 0.5 : -0.5) * stretch;
    // Between two points that follow each other nothing is seen, either.
    const double unseen = frame.of(cloud.points[transitions[k].first]).y() -
                          frame.of(cloud.points[transitions[k].last]).y();
    hidden[lower] += std::clamp(unseen, 0.0, most) / static_cast<double>(transitions.size());
  }
  return hidden;
}

// An even distribution over what is hidden is common to all stripes: more of them tell no more.
void widen(LineFit& border, double hidden, const std::vector<LinePlace>& ends) {
  const auto [first, last] =
      std::minmax_element(ends.begin(), ends.end(),
                          [](const LinePlace& a, const LinePlace& b) { return a.along < b.along; });
  const double variance = hidden * hidden / 12, half = (last->along - first->along) / 2;
  border.variance += variance;
  if (half > 0) border.slope_variance += variance / (half * half);
}

// Whether the stripes run through the gap in one piece, so that they end at neither plate.
bool run_through(const ScanCloud& cloud, const std::vector<Transition>& transitions) {
  const auto through = [&](const Transition& transition) {
    return !cloud.origins[transition.last].segment_end &&
           !cloud.origins[transition.first].segment_end;
  };
  return 2 * std::count_if(transitions.begin(), transitions.end(), through) >
         std::ssize(transitions);
}

// All that stripes show between the first and the last of the transitions and near their line; and
// how the line of sight runs there, mm across for each mm down.
std::pair<std::vector<SeenPlace>, double> seen_near(const ScanCloud& cloud,
                                                    const std::vector<Transition>& transitions,
                                                    const PlateFrame& frame,
                                                    const std::array<Plane, 2>& planes,
                                                    const ButtGapSearch& rough) {
  double from = std::numeric_limits<double>::infinity(), to = -from;
  for (const Transition& transition : transitions) {
    const double along = frame.of(cloud.points[transition.last]).x();
    from = std::min(from, along), to = std::max(to, along);
  }
  std::vector<SeenPlace> places;
  double across = 0, down = 0;
  for (int i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d& point = cloud.points[i];
    const Eigen::Vector3d p = frame.of(point);
    const double beside = p.y() - rough.across - rough.slope * (p.x() - rough.middle);
    if (std::abs(beside) > kJoints.gap_reach || p.x() < from || p.x() > to ||
        std::abs(p.z()) > 2 * kJoints.gap_reach)
      continue;
    const Plane& plane = planes[beside > 0];
    const double height = plane.signed_distance(point);
    const Eigen::Vector3d sight = point - cloud.seen_from(i);
    const Eigen::Vector3d top = frame.of(point - height / plane.normal.dot(sight) * sight);
    places.push_back({top.x(), top.y(), height});
    across += frame.across.dot(sight), down -= frame.normal.dot(sight);
  }
  return {places, down > 0 ? across / down : 0};
}

// Both borders by all stripes together, where the plates lie at one level and are seen into
// between.
std::optional<std::array<LineFit, 2>> butt_edges(const ScanCloud& cloud,
                                                 const std::vector<Transition>& transitions,
                                                 const PlateFrame& frame,
                                                 const std::array<Plane, 2>& planes,
                                                 const LineFit& first, const LineFit& second,
                                                 double near_mm) {
  ButtGapSearch search;
  search.middle = first.middle;
  search.across = (first.at_middle + second.across_at(first.middle)) / 2;
  search.slope = (first.slope + second.slope) / 2;
  search.noise = std::max(kJoints.gap_noise, near_mm / kFit.on_plane);
  const Eigen::Vector3d at =
      frame.origin + search.middle * frame.along + search.across * frame.across;
  if (std::abs(planes[0].signed_distance(at) - planes[1].signed_distance(at)) > kJoints.one_level)
    return std::nullopt;
  const auto [places, sight] = seen_near(cloud, transitions, frame, planes, search);
  search.sight = sight;
  if (!(std::abs(sight) > kJoints.least_gap_sight)) return std::nullopt;
  return fit_butt_gap(places, search);
}

}  // namespace

bool sees_below(const ScanCloud& cloud, const Transition& transition,
                const std::array<Plane, 2>& planes, double near_mm) {
  return std::any_of(transition.between.begin(), transition.between.end(), [&](int i) {
    // Where light ends on a cut, its last centre is off by as much down as across.
    const double off = cloud.origins[i].segment_end ? 3 * kJoints.jump_deviation : 2 * near_mm;
    return std::max(planes[0].signed_distance(cloud.points[i]),
                    planes[1].signed_distance(cloud.points[i])) < -off;
  });
}

bool is_covered(const ScanCloud& cloud, const Transition& transition,
                const std::array<Plane, 2>& planes, double near_mm) {
  return std::any_of(transition.between.begin(), transition.between.end(), [&](int i) {
    return std::min(planes[0].signed_distance(cloud.points[i]),
                    planes[1].signed_distance(cloud.points[i])) > 2 * near_mm;
  });
}

std::vector<Transition> showing_edges(const ScanCloud& cloud,
                                      const std::vector<Transition>& transitions,
                                      const std::array<Plane, 2>& planes, double near_mm) {
  std::vector<Transition> bare;
  std::copy_if(transitions.begin(), transitions.end(), std::back_inserter(bare),
               [&](const Transition& transition) {
                 return !is_covered(cloud, transition, planes, near_mm);
               });
  return bare;
}

ParallelEdges edges_of(const ScanCloud& cloud, const std::vector<Transition>& transitions,
                       const PlateFrame& frame, const std::array<Plane, 2>& planes, double near_mm,
                       double pitch_mm) {
  ParallelEdges borders;
  std::array<std::vector<LinePlace>, 2> ends;
  for (int plate = 0; plate < 2; ++plate)
    for (const Transition& transition : transitions)
      ends[plate].push_back(
          end_place(cloud, transition, frame, plate, follower(cloud, transition, plate), pitch_mm));
  const auto hidden = beside_a_step(cloud, transitions, frame, planes, near_mm, ends);
  for (int plate = 0; plate < 2; ++plate) {
    std::vector<LinePlace> cut, ends_on_cut;
    double deepest = 0;
    for (const Transition& transition : transitions) {
      const auto run = falling(cloud, transition, frame, planes[plate], plate, near_mm);
      if (const int i = end_on_cut(cloud, transition, planes[plate], plate, near_mm); i >= 0) {
        const Eigen::Vector3d p = frame.of(cloud.points[i]);
        ends_on_cut.push_back({p.x(), p.y(), 0, kJoints.cut_deviation});
      }
      // One alone may lie on the other plate's cut, across the gap.
      const auto below = [&](int i) {
        return planes[plate].signed_distance(cloud.points[i]) <= -2 * near_mm;
      };
      if (std::count_if(run.begin(), run.end(), below) < 2) continue;
      for (const int i : run) {
        if (!below(i)) continue;
        const Eigen::Vector3d p = frame.of(cloud.points[i]);
        cut.push_back(
            {p.x(), p.y(), planes[plate].signed_distance(cloud.points[i]), kJoints.cut_deviation});
        deepest = std::min(deepest, cut.back().height);
      }
    }
    borders.depth = std::max(borders.depth, -deepest);
    if (cut.size() >= kJoints.cut_points && -deepest > kJoints.least_depth) {
      // Falling away from plate 0 is toward larger across. What does not slant open is cut square.
      // A slant begins where the plate ends; what smoothing makes of a square cut across a gap does
      // not.
      const auto top = fit_line(ends[plate], kJoints.square_cut);
      if (const auto fit = fit_line(cut, kJoints.free_cut);
          fit && std::atan((plate == 0 ? -1 : 1) * fit->lean) > kJoints.slanting &&
          (!top || std::abs(fit->at_middle - top->across_at(fit->middle)) < kJoints.on_line / 2)) {
        borders.plates[plate] = fit;
        borders.slants[plate] = std::atan((plate == 0 ? -1 : 1) * fit->lean);
        continue;
      }
    }
    const bool parted = 2 * ends_on_cut.size() > transitions.size();
    borders.together |= parted;
    borders.plates[plate] = fit_line(parted ? ends_on_cut : ends[plate], kJoints.square_cut);
    if (!parted && borders.plates[plate]) widen(*borders.plates[plate], hidden[plate], ends[plate]);
  }
  const auto& [first, second] = borders.plates;
  if (borders.slants[0] || borders.slants[1] || !first || !second || !cloud.organised() ||
      !run_through(cloud, transitions) || hidden[0] + hidden[1] > 0)
    return borders;
  const auto narrow = butt_edges(cloud, transitions, frame, planes, *first, *second, near_mm);
  if (!narrow) return borders;
  borders.plates = {(*narrow)[0], (*narrow)[1]};
  borders.together = true;
  return borders;
}

}  // namespace arcstart::seam_finding
