#include "services/seam_finding/ends.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "services/seam_finding/interruption.hpp"
#include "services/seam_finding/plate_extent.hpp"

namespace arcstart {
namespace {

constexpr double kNearSeam = 3, kBeside = 25;  // from the seam in a plate; mm
constexpr double kStandsBefore = 3;            // mm
constexpr double kFlush = 0.3;                 // share of joints whose plates end together
constexpr double kFlushWithin = 0.6;           // mm
constexpr double kLight = 0.15;                // half a stripe's width: seen where it falls; mm
constexpr double kOffsets = 40;                // the others end so far about each other; mm
constexpr double kSameEdge = 2.5;              // standard deviations of their difference
// A stripe shows a plate at the seam also where it leaves it a little before; mm along the seam.
constexpr double kMargin = 0.5;
constexpr double kUnseen = 2;  // a stripe that leaves a plate so near may not show it; of `near`
constexpr double kBeyond = 3;  // stripe spacings
constexpr double kMostSlant = 0.5;  // of that for each mm before it

// What the stripes say of where a plate begins at the seam. Places count outward: they rise toward
// the side that is looked at, whichever it is.
struct Bracket {
  double inner = 0, outer = 0;  // it is there, and is not; mm
  bool runs_on = false;         // it is there beyond the seam's end, too
};

Bracket bracket_of(const Stations& stations, int plate, double end, double outward) {
  Bracket bracket{end, end, false};
  double inner = -1e9, outer = 1e9;
  bool shown = false;
  for (const Station& station : stations.list) {
    if (!station.known) continue;
    const double place = outward * (station.along - end);
    if (place <= 0 && stations.both(station)) inner = std::max(inner, place);
    if (place > 0 && place < outer) {
      outer = place;
      shown = station.nearest[plate] <= stations.near[plate];
    }
  }
  if (inner > -1e8) bracket.inner = end + outward * inner;
  if (outer < 1e8) bracket.outer = end + outward * outer;
  bracket.runs_on = shown;
  return bracket;
}

// How much earlier than it crosses the seam a stripe that shows a plate there may leave it.
double unsure_of(const Stations& stations, int plate) {
  return kMargin + kMostSlant * stations.near[plate];
}

// By what is seen on the plate and past it. A plate that is seen beyond the stripes which do not
// show it at the seam was only hidden there.
void narrow(Bracket& bracket, const PlateExtent& extent, double unsure, double margin,
            double outward) {
  const double inner = std::isfinite(extent.on)
                           ? std::max(extent.on, outward * bracket.inner - unsure)
                           : outward * bracket.inner;
  double outer = outward * bracket.outer + margin;
  if (extent.on > outer) {
    outer = extent.past;
    bracket.runs_on = !std::isfinite(outer);
  }
  outer = std::min(outer, extent.past);
  if (inner < outer && std::isfinite(outer))
    bracket.inner = outward * inner, bracket.outer = outward * outer;
}

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
  const double place = outward * edge.along, allowed = kSameEdge * std::sqrt(edge.variance);
  return place > extent.on - allowed && (edge.stripes > 1 || place < extent.past + allowed);
}

// Of two plates' edges the lone stripe's that lies inside the other's, which several tell.
bool ends_early(const PlateEdge& edge, const PlateEdge& other, double outward) {
  return edge.stripes == 1 && other.stripes > 1 && !other.occluded &&
         outward * (other.along - edge.along) >
             kSameEdge * std::sqrt(edge.variance + other.variance);
}

// Of two plates the one that ends the seam first, where the second is known by a bracket only. Two
// plates are often set flush; else the one ends anywhere about the other's end.
void limit_by_bracket(SeamEnd& end, const Bracket& bracket, double outward) {
  const double inner = outward * bracket.inner, outer = outward * bracket.outer;
  const double edge = outward * end.along;
  if (edge <= inner || !(outer > inner)) return;
  const double high = std::min(edge, outer), per_mm = (1 - kFlush) / kOffsets;
  // A stripe beside the plate lets some of its light fall on it where it lies nearer than that.
  const double beside = (outer - kLight - edge) / std::sqrt(end.variance);
  const double flush = kFlush * 0.5 * std::erfc(-beside / std::sqrt(2.0));
  const double share = per_mm * (high - inner) / (per_mm * (outer - inner) + flush);
  const double middle = (inner + high) / 2;
  const double mean = share * middle + (1 - share) * edge;
  const double within = (high - inner) * (high - inner) / 12;
  end.variance = share * (within + std::pow(middle - mean, 2)) +
                 (1 - share) * (end.variance + std::pow(edge - mean, 2));
  end.along = outward * mean;
}

// Where no plate's edge is known. Nothing is changed where both plates run on.
void between_brackets(SeamEnd& end, const std::array<Bracket, 2>& brackets, double outward) {
  double inner = 1e9, outer = 1e9;
  for (const Bracket& bracket : brackets) {
    if (bracket.runs_on) continue;
    inner = std::min(inner, outward * bracket.inner);
    outer = std::min(outer, outward * bracket.outer);
  }
  if (!(outer > inner)) return;
  end.along = outward * (inner + outer) / 2;
  end.variance = (outer - inner) * (outer - inner) / 12;
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
      if (r < kNearSeam || r > kBeside ||
          std::abs(plates[1 - j].plane.signed_distance(cloud.points[i])) <= tolerance)
        continue;
      // Something stands before the plate, or it is there and was measured badly.
      const double height = plates[j].plane.signed_distance(cloud.points[i]);
      if (height > kStandsBefore) return EndVisibility::kHidden;
      if (height > -kStandsBefore) visibility = EndVisibility::kNotDetermined;
    }
  }
  return visibility;
}

// How far both plates are seen to reach, along the line, where that is behind something that hides
// the seam; nothing where it is not, or no farther than `end` by more than `width`.
std::optional<double> both_reach(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                                 const std::array<PlateStripes, 2>& stripes,
                                 const Stations& stations, SeamSide side, double end, double width,
                                 const EndSearch& search) {
  if (!stands_before(cloud, plates, stripes[0].line, stations, end, kBeside)) return std::nullopt;
  const double outward = side == SeamSide::kEnd ? 1 : -1;
  double reach = std::numeric_limits<double>::infinity();
  for (int j = 0; j < 2; ++j)
    reach = std::min(reach, seen_on_plate(cloud, stripes[j], side, search));
  if (!(reach > outward * end + width)) return std::nullopt;
  return outward * reach;
}

// About a place between two stripes. Where `reach` is given no stripe shows the seam between the
// course and that place, up to which both plates are there.
SeamEnd find_end(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates, const Line& line,
                 double along, std::optional<double> reach,
                 const std::array<PlateStripes, 2>& stripes, const Stations& stations,
                 SeamSide side, const EndSearch& search) {
  const bool begin = side == SeamSide::kBegin;
  const double outward = begin ? -1 : 1;
  SeamEnd end;
  end.along = along;
  end.visibility = EndVisibility::kSeen;
  std::array<Bracket, 2> brackets;
  for (int j = 0; j < 2; ++j) {
    brackets[j] = bracket_of(stations, j, end.along, outward);
    if (reach) brackets[j].inner = *reach;
  }
  const double width = std::abs(brackets[0].outer - brackets[0].inner);
  end.variance = width * width / 12;

  std::array<std::optional<PlateEdge>, 2> edges;
  std::array<EdgeSearch, 2> searches;
  for (int j = 0; j < 2; ++j) {
    EdgeSearch& edge_search = searches[j];
    const double margin = unsure_of(stations, j);
    const double inner = brackets[j].inner - outward * margin;
    const double outer = brackets[j].outer + outward * std::max(margin, width);
    edge_search.from = std::min(inner, outer);
    edge_search.to = std::max(inner, outer);
    edge_search.beyond = kBeyond * width;
    edge_search.tolerance = search.tolerance;
    edge_search.noise = search.noise;
    edge_search.shortening_px = search.shortening_px;
    edges[j] = find_edge(cloud, stripes[j], side, edge_search);
  }
  std::array<PlateExtent, 2> extents;
  for (int j = 0; j < 2; ++j) {
    if (!edges[j] && brackets[j].runs_on) continue;
    PlateExtent& extent = extents[j];
    // Of several stripes' edge no more is asked than whether the plate goes on behind it.
    extent.on = seen_on_plate(cloud, stripes[j], side, search);
    if (edges[j] && edges[j]->stripes > 1 && possible(*edges[j], extent, outward)) continue;
    extent =
        plate_extent(cloud, stripes[j], side, end.along, search, crossings_of(cloud, stations, j));
    if (edges[j] && !possible(*edges[j], extent, outward)) edges[j].reset();
    // Where stripes cross the one plate's edge, they may leave this one unseen.
    const double slant = edges[1 - j] ? std::max(0.0, outward * stations.slant[j]) : 0;
    if (!edges[j])
      narrow(brackets[j], extent, unsure_of(stations, j), kUnseen * stations.near[j] * slant,
             outward);
  }
  // Of single stripes, the one that agrees with the other plate's edge.
  for (int j = 0; j < 2; ++j) {
    if (!edges[0] || !edges[1] || edges[j]->stripes > 1 || edges[1 - j]->stripes < 2) continue;
    searches[j].beyond = 0;
    searches[j].from = edges[1 - j]->along - kFlushWithin;
    searches[j].to = edges[1 - j]->along + kFlushWithin;
    if (const auto flush = find_edge(cloud, stripes[j], side, searches[j])) edges[j] = flush;
  }
  // A lone stripe that ends before the other plate does may end in a shadow, or behind something:
  // the plate reaches at least so far.
  for (int j = 0; j < 2; ++j) {
    if (!edges[0] || !edges[1] || !ends_early(*edges[j], *edges[1 - j], outward)) continue;
    if (!edges[j]->occluded &&
        !stands_before(cloud, plates, line, stations, edges[j]->along, kBeside))
      continue;
    extents[j].on = std::max(extents[j].on, outward * edges[j]->along);
    narrow(brackets[j], extents[j], unsure_of(stations, j), 0, outward);
    edges[j].reset();
  }
  if (!edges[0] && !edges[1]) {
    const auto behind =
        reach ? std::nullopt
              : both_reach(cloud, plates, stripes, stations, side, end.along, width, search);
    if (behind)  // the stripe that shows a plate so far need not show it at the seam
      return find_end(cloud, plates, line, *behind + outward * width / 2, behind, stripes, stations,
                      side, search);
    between_brackets(end, brackets, outward);
    end.visibility =
        seen_beyond(cloud, stations, plates, line, end.along, outward, search.tolerance);
    return end;
  }
  end.by_edges = true;
  PlateEdge edge = edges[0] ? *edges[0] : *edges[1];
  if (edges[0] && edges[1]) {
    const PlateEdge &a = *edges[0], &b = *edges[1];
    const double difference = a.along - b.along, variance = a.variance + b.variance;
    if (difference * difference <= kSameEdge * kSameEdge * variance && a.occluded == b.occluded) {
      edge.along = (a.along * b.variance + b.along * a.variance) / variance;
      edge.variance = a.variance * b.variance / variance;
    } else {
      edge = (a.along > b.along) == begin ? a : b;
    }
  }
  end.along = edge.along;
  end.variance = edge.variance;
  for (int j = 0; j < 2; ++j)
    if (!edges[j] && !brackets[j].runs_on) limit_by_bracket(end, brackets[j], outward);
  if (edge.occluded) end.visibility = EndVisibility::kHidden;
  return end;
}

}  // namespace

SeamEnd find_end(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates, const Line& line,
                 const Course& course, const std::array<PlateStripes, 2>& stripes, SeamSide side,
                 const EndSearch& search) {
  const bool begin = side == SeamSide::kBegin;
  const double along = begin ? course.begin : course.end;
  if (!(begin ? course.begins_outside : course.ends_outside))
    return find_end(cloud, plates, line, along, std::nullopt, stripes, course.stations, side,
                    search);
  const Bracket bracket = bracket_of(course.stations, 0, along, begin ? -1 : 1);
  SeamEnd end{along, std::pow(bracket.outer - bracket.inner, 2) / 12};
  end.visibility = EndVisibility::kOutside;
  return end;
}

}  // namespace arcstart
