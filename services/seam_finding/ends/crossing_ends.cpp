#include "services/seam_finding/ends/crossing_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "services/seam_finding/ends/constants.hpp"
#include "services/seam_finding/ends/edge_crossing.hpp"
#include "services/seam_finding/ends/end_interval.hpp"
#include "services/seam_finding/ends/plate_end.hpp"
#include "services/seam_finding/visibility/occlusion.hpp"
#include "services/seam_finding/visibility/plate_extent.hpp"

namespace arcstart::seam_finding {
namespace {

// Of the stripes that show the other plate, by which their crossings are known.
StripeCrossings crossings_of(const ScanCloud& cloud, const Stations& stations, int plate) {
  StripeCrossings crossings{std::vector<std::optional<double>>(cloud.stripes.size()),
                            stations.slant[plate]};
  for (const Station& station : stations.list)
    if (station.stripe >= 0 && station.known &&
        station.nearest[1 - plate] <= stations.near[1 - plate])
      crossings.along[station.stripe] = station.along;
  return crossings;
}

// Stripes may end for another reason than the plate's edge: in a shadow, or behind something. What
// is seen past a plate speaks against a lone one alone.
bool possible(const PlateEdge& edge, const PlateExtent& extent, double outward) {
  const double place = outward * edge.along,
               allowed = kEnds.same_edge *
                         std::hypot(std::sqrt(edge.variance), kEnds.light_extent * edge.pixel);
  return place > extent.on - allowed && (edge.stripes > 1 || place < extent.past + allowed);
}

// Of two plates' edges the lone stripe's that lies inside the other's, which several tell.
bool ends_early(const PlateEdge& edge, const PlateEdge& other, double outward) {
  return edge.stripes == 1 && other.stripes > 1 && !other.occluded &&
         outward * (other.along - edge.along) >
             kEnds.same_edge * std::sqrt(edge.variance + other.variance);
}

// Of the stripe right beyond the seam's end that no longer shows a plate: whether the plate is seen
// to have ended.
EndVisibility seen_beyond(const ScanCloud& cloud, const Stations& stations,
                          const std::array<JointPlate, 2>& plates, const Line& line, double end,
                          double outward, double tolerance) {
  const Station* next = nullptr;
  for (const Station& station : stations.list)
    if (station.known && station.stripe >= 0 && outward * (station.along - end) > 0 &&
        (next == nullptr || outward * (station.along - next->along) < 0))
      next = &station;
  if (next == nullptr) return EndVisibility::kNotDetermined;
  const ScanStripe& stripe = cloud.stripes[next->stripe];
  EndVisibility visibility = EndVisibility::kSeen;
  for (int j = 0; j < 2; ++j) {
    if (next->nearest[j] <= stations.near[j]) continue;
    const Eigen::Vector3d away = away_from_seam(plates[j], plates[1 - j]);
    for (int i = stripe.first; i < stripe.first + stripe.count; ++i) {
      const double r = away.dot(cloud.points[i] - line.point);
      if (r < kVisibility.near_seam || r > kModel.beside_seam ||
          std::abs(plates[1 - j].plane.signed_distance(cloud.points[i])) <= tolerance)
        continue;
      // Something stands before the plate, or it is there and was measured badly.
      const double height = plates[j].plane.signed_distance(cloud.points[i]);
      if (height > kEnds.hides) return EndVisibility::kHidden;
      if (height > -kEnds.hides) visibility = EndVisibility::kNotDetermined;
    }
  }
  return visibility;
}

// One end of a seam. The steps follow each other as they stand.
class EndFinder {
 public:
  EndFinder(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
            const std::array<PlateStripes, 2>& stripes, const Stations& stations, SeamSide side,
            const Scales& scales, const SeamFindingSettings& settings)
      : cloud_(cloud),
        plates_(plates),
        stripes_(stripes),
        stations_(stations),
        side_(side),
        outward_(side == SeamSide::kEnd ? 1 : -1),
        scales_(scales),
        settings_(settings) {}

  // About a place between two stripes. Where `reach` is given no stripe shows the seam between the
  // coverage and that place, up to which both plates are there.
  SeamEnd find(double along, std::optional<double> reach = std::nullopt) {
    extents_ = {};
    for (int j = 0; j < 2; ++j) {
      intervals_[j] = interval_of(stations_, j, along, outward_);
      if (reach) intervals_[j].inner = *reach;
    }
    const double width = std::abs(intervals_[0].outer - intervals_[0].inner);
    SeamEnd end{along, width * width / 12};
    end.visibility = EndVisibility::kSeen;
    for (int j = 0; j < 2; ++j) seek_edge(j, width);
    // A stripe that shows nothing of a plate behind what hides the seam tells nothing of its end.
    if (reach)
      for (EndInterval& interval : intervals_)
        interval.outer = outward_ * std::numeric_limits<double>::infinity();
    for (int j = 0; j < 2; ++j) compare_with_extent(j, along);
    for (int j = 0; j < 2; ++j) seek_flush_edge(j);
    for (int j = 0; j < 2; ++j) drop_early_edge(j);
    if (edges_[0] || edges_[1]) {
      by_edges(end);
      return end;
    }
    const auto behind = reach ? std::nullopt : both_reach(along, width);
    if (behind)  // the stripe that shows a plate so far need not show it at the seam
      return find(*behind + outward_ * width / 2, behind);
    between_intervals(end, intervals_, outward_);
    end.visibility =
        seen_beyond(cloud_, stations_, plates_, line(), end.along, outward_, scales_.tolerance);
    return end;
  }

 private:
  const Line& line() const { return stripes_[0].line; }
  bool hidden(int j, double along) const {
    return may_hide(cloud_, plates_[j], plates_[1 - j], line().at(along));
  }

  void seek_edge(int j, double width) {
    EdgeWindow& window = windows_[j];
    const double margin = unsure_of(stations_, j);
    const double inner = intervals_[j].inner - outward_ * margin;
    const double outer = intervals_[j].outer + outward_ * std::max(margin, width);
    window.from = std::min(inner, outer);
    window.to = std::max(inner, outer);
    window.beyond = kEnds.beyond * width;
    edges_[j] = find_edge(cloud_, stripes_[j], side_, window, scales_, settings_);
  }

  // Of several stripes' edge no more is asked than whether the plate goes on behind it.
  void compare_with_extent(int j, double along) {
    if (!edges_[j] && intervals_[j].runs_on) {
      // So it says up to the next stripe; the other plate may end much farther out.
      if (!edges_[1 - j] ||
          outward_ * (edges_[1 - j]->along - intervals_[j].outer) < kEnds.farther_out)
        return;
      intervals_[j] = {intervals_[j].inner, outward_ * std::numeric_limits<double>::infinity()};
    }
    PlateExtent& extent = extents_[j];
    const StripeCrossings crossings = crossings_of(cloud_, stations_, j);
    const double slope = edges_[j] ? edges_[j]->slope : 0;
    extent.on = seen_on_plate(cloud_, stripes_[j], side_, along, slope, scales_, crossings);
    if (edges_[j] && edges_[j]->stripes > 1) {
      // What lies in the plate's plane farther from the seam than they tell its edge may be another
      // thing.
      PlateExtent beside = extent;
      beside.on = seen_on_plate(cloud_, stripes_[j], side_, along, slope, scales_, crossings,
                                edges_[j]->clear_to + kEnds.beside_edge);
      if (possible(*edges_[j], beside, outward_)) return;
    }
    extent = plate_extent(cloud_, stripes_[j], side_, along, slope, scales_, crossings);
    if (edges_[j] && !possible(*edges_[j], extent, outward_)) edges_[j].reset();
    // Nor, where something is seen past the plate, does one that shows nothing of it behind what
    // may hide it.
    if (!intervals_[j].runs_on && std::isfinite(extent.past) && hidden(j, along))
      intervals_[j].outer = outward_ * std::numeric_limits<double>::infinity();
    // Where stripes cross the one plate's edge, they may leave this one unseen.
    const double stripes_slant = edges_[1 - j] ? std::max(0.0, outward_ * stations_.slant[j]) : 0;
    if (!edges_[j])
      narrow(intervals_[j], extent, unsure_of(stations_, j),
             kEnds.unseen * stations_.near[j] * stripes_slant, outward_);
  }

  // Of single stripes, the one that agrees with the other plate's edge.
  void seek_flush_edge(int j) {
    if (!edges_[0] || !edges_[1] || edges_[j]->stripes > 1 || edges_[1 - j]->stripes < 2) return;
    windows_[j].beyond = 0;
    windows_[j].from = edges_[1 - j]->along - kEnds.flush_within;
    windows_[j].to = edges_[1 - j]->along + kEnds.flush_within;
    if (const auto flush = find_edge(cloud_, stripes_[j], side_, windows_[j], scales_, settings_))
      edges_[j] = flush;
  }

  // A lone stripe that ends before the other plate does may end in a shadow, or behind something:
  // the plate reaches at least so far.
  void drop_early_edge(int j) {
    if (!edges_[0] || !edges_[1] || !ends_early(*edges_[j], *edges_[1 - j], outward_)) return;
    const PlateEdge& edge = *edges_[j];
    const Eigen::Vector3d place = line().at(edge.along) + edge.away * stripes_[j].away;
    if (!edge.occluded && !may_hide(cloud_, plates_[j], plates_[1 - j], place)) return;
    extents_[j].on = std::max(extents_[j].on, outward_ * edge.along);
    narrow(intervals_[j], extents_[j], unsure_of(stations_, j), 0, outward_);
    edges_[j].reset();
  }

  void by_edges(SeamEnd& end) const {
    PlateEdge edge = edges_[0] ? *edges_[0] : *edges_[1];
    if (edges_[0] && edges_[1]) {
      const PlateEdge &a = *edges_[0], &b = *edges_[1];
      edge = outward_ * a.along < outward_ * b.along ? a : b;
      if (a.occluded == b.occluded) {
        const CommonEnd both = end_of_both(a, b, side_);
        edge.along = both.along, edge.variance = both.variance;
      }
    }
    end.by_edges = true;
    end.along = edge.along;
    end.variance = edge.variance;
    for (int j = 0; j < 2; ++j) {
      if (edges_[j] || intervals_[j].runs_on) continue;
      limit_by_interval(end, intervals_[j], outward_);
      if (end.along != edge.along && hidden(j, end.along))
        end.visibility = EndVisibility::kNotDetermined;
    }
    if (edge.occluded) end.visibility = EndVisibility::kHidden;
  }

  // How far both plates are seen to reach, along the line, where that is behind something that
  // hides the seam; nothing where it is not, or no farther than `end` by more than `width`.
  std::optional<double> both_reach(double end, double width) const {
    if (!stands_before(cloud_, plates_, line(), stations_, end, kModel.beside_seam))
      return std::nullopt;
    double reach = std::numeric_limits<double>::infinity();
    for (int j = 0; j < 2; ++j)
      reach = std::min(reach, seen_on_plate(cloud_, stripes_[j], side_, end, 0, scales_,
                                            crossings_of(cloud_, stations_, j)));
    if (!(reach > outward_ * end + width)) return std::nullopt;
    return outward_ * reach;
  }

  const ScanCloud& cloud_;
  const std::array<JointPlate, 2>& plates_;
  const std::array<PlateStripes, 2>& stripes_;
  const Stations& stations_;
  SeamSide side_;
  double outward_;  // places times this rise outward
  const Scales& scales_;
  const SeamFindingSettings& settings_;
  std::array<EndInterval, 2> intervals_;
  std::array<EdgeWindow, 2> windows_;
  std::array<std::optional<PlateEdge>, 2> edges_;
  std::array<PlateExtent, 2> extents_;
};

}  // namespace

std::array<SeamEnd, 2> find_crossing_ends(const ScanCloud& cloud, const Joint& joint,
                                          const Scales& scales,
                                          const SeamFindingSettings& settings) {
  const auto stripes = plate_stripes(cloud, joint.plates, joint.line, scales);
  const Coverage& course = joint.coverage;
  const auto end_at = [&](SeamSide side) {
    const bool begin = side == SeamSide::kBegin;
    const double along = begin ? course.begin : course.end;
    if (!(begin ? course.begins_outside : course.ends_outside))
      return EndFinder(cloud, joint.plates, stripes, course.stations, side, scales, settings)
          .find(along);
    const EndInterval interval = interval_of(course.stations, 0, along, begin ? -1 : 1);
    SeamEnd end{along, std::pow(interval.outer - interval.inner, 2) / 12};
    end.visibility = EndVisibility::kOutside;
    return end;
  };
  return {end_at(SeamSide::kBegin), end_at(SeamSide::kEnd)};
}

}  // namespace arcstart::seam_finding
