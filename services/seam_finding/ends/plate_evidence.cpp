#include "services/seam_finding/ends/plate_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "common/order_statistics.hpp"
#include "services/seam_finding/ends/constants.hpp"

namespace arcstart::seam_finding {
namespace {

// Along the line, square to it in the plate, and over the plate, of what stands before both; mm.
struct Standing {
  double along, away, height;
};

// What a stripe shows, whichever end is looked for; places along the line.
struct Seen {
  bool shown = false, covered = false;  // the plate at the seam; something before it
  std::vector<Stretch> on, off;
  std::vector<EdgeCrossing> edges;
};

class Collector {
 public:
  Collector(const ScanCloud& cloud, const PlateStripes& stripes, double tolerance)
      : cloud_(cloud),
        stripes_(stripes),
        tolerance_(tolerance),
        far_(std::min(kVisibility.farthest, stripes.reach) - kVisibility.near_seam) {}

  PlacePart part(const Eigen::Vector3d& point) const {
    return {stripes_.line.along(point), stripes_.away.dot(point - stripes_.line.point)};
  }

  // Pieces of the plate in a stripe, of neighbours enough that chance put none there; fewer are
  // enough where the stripe comes off the other plate.
  std::vector<Stretch> on(const std::vector<int>& run) const {
    std::vector<Stretch> pieces;
    for (auto begin = run.begin(), end = begin; begin != run.end(); begin = end) {
      for (++end; end != run.end() && *end == end[-1] + 1 &&
                  cloud_.origins[*end].segment == cloud_.origins[*begin].segment;)
        ++end;
      if (end - begin >= kModel.sure_points || of_other(*begin - 1, *begin) ||
          of_other(end[-1] + 1, *begin))
        pieces.push_back({part(cloud_.points[*begin]), part(cloud_.points[end[-1]])});
    }
    return pieces;
  }

  // Where the lines of sight to what lies behind the plate cross it, farther from the seam than
  // `near`, mm: nearer, it may be the plate's own round edge.
  std::vector<Stretch> off(const ScanStripe& stripe, double near) const {
    std::vector<Stretch> pieces;
    std::vector<PlacePart> row;
    const auto close = [&] {
      if (static_cast<int>(row.size()) >= kModel.sure_points)
        pieces.push_back({row.front(), row.back()});
      row.clear();
    };
    const int step = every(kEnds.looked_behind, stripe);
    int last = -1;
    for (int i = stripe.first; i < stripe.first + stripe.count; i += step) {
      if (height_over(stripes_, cloud_.points[i]) >= -tolerance_) continue;
      const auto through = seen_through(cloud_, stripes_, i, tolerance_);
      if (!through) continue;
      const PlacePart place = part(*through);
      if (place.away <= near || place.away >= far_) continue;
      if (!row.empty() &&
          (i != last + step || cloud_.origins[i].segment != cloud_.origins[last].segment))
        close();
      row.push_back(place), last = i;
    }
    close();
    return pieces;
  }

  std::vector<Standing> standing() const {
    std::vector<Standing> list;
    for (const ScanStripe& stripe : cloud_.stripes) {
      const int step = every(kEnds.looked_before, stripe);
      for (int i = stripe.first; i < stripe.first + stripe.count; i += step) {
        const Eigen::Vector3d& point = cloud_.points[i];
        const double height = stripes_.plate.plane.signed_distance(point);
        if (height <= kVisibility.stands_before ||
            stripes_.other.plane.signed_distance(point) <= kVisibility.stands_before)
          continue;
        const PlacePart place = part(point);
        if (place.away < kVisibility.before_reach) list.push_back({place.out, place.away, height});
      }
    }
    return list;
  }

  // Whether it shows the plate, bent as it may be, as near to the seam as others do.
  bool shows_within(double near, const std::vector<int>& run) const {
    return static_cast<int>(run.size()) >= kModel.sure_points &&
           std::min(part(cloud_.points[run.front()]).away, part(cloud_.points[run.back()]).away) <=
               near;
  }

  // Whether what a stripe shows may be the other plate's cut, in this one's face: it ends no
  // farther from the seam than that may reach, just as far as beside it, as no end of a plate does,
  // and to one side along the seam nothing shows more of the plate.
  bool shows_only_cut(int stripe) const {
    const double reach = reach_of(stripe), most = reach + kEnds.side_edge;
    if (!(reach > 0 && reach < stripes_.cut)) return false;
    const auto as_far = [&](int other) {
      return reach_of(other) < most && reach_of(other) > reach - kEnds.side_edge;
    };
    const auto shows_more = [&](int from, int to) {
      for (int k = from; k < to; ++k)
        if (reach_of(k) > most) return true;
      return false;
    };
    const int stripes = static_cast<int>(stripes_.runs.size());
    return (as_far(stripe - 1) || as_far(stripe + 1)) &&
           !(shows_more(0, stripe) && shows_more(stripe + 1, stripes));
  }

  // Away from the seam, where half of the stripes first show the plate: behind a gap or a radius.
  double begin() const {
    std::vector<double> nearest;
    for (const auto& run : stripes_.runs)
      if (!run.empty())
        nearest.push_back(
            std::min(part(cloud_.points[run.front()]).away, part(cloud_.points[run.back()]).away));
    return median(nearest);
  }

 private:
  // Whether a point is the other plate's, in the same segment as one on this.
  bool of_other(int i, int on_this) const {
    const std::vector<int>& points = stripes_.other.points;
    return i >= 0 && i < cloud_.size() && cloud_.origins[i].stripe >= 0 &&
           cloud_.origins[i].stripe == cloud_.origins[on_this].stripe &&
           cloud_.origins[i].segment == cloud_.origins[on_this].segment &&
           std::binary_search(points.begin(), points.end(), i);
  }

  // How far from the seam a stripe shows the plate; mm, 0 where it does not.
  double reach_of(int stripe) const {
    if (stripe < 0 || stripe >= std::ssize(stripes_.runs) || stripes_.runs[stripe].empty())
      return 0;
    const std::vector<int>& run = stripes_.runs[stripe];
    return std::max(part(cloud_.points[run.front()]).away, part(cloud_.points[run.back()]).away);
  }

  // Of points that stand nearer to each other than is needed, one in so many.
  int every(double way, const ScanStripe& stripe) const {
    if (stripe.count < 2) return 1;
    const double length =
        (cloud_.points[stripe.first + stripe.count - 1] - cloud_.points[stripe.first]).norm();
    // Its ends may lie at one place.
    if (!(length > way)) return 1;
    return std::max(1, static_cast<int>(way * stripe.count / length));
  }

  const ScanCloud& cloud_;
  const PlateStripes& stripes_;
  double tolerance_, far_;
};

// Whether things stand so near the seam at that place along it, for their height, that they may
// hide the plate there or keep the light from it.
bool covers(const std::vector<Standing>& standing, double along) {
  return std::count_if(standing.begin(), standing.end(), [&](const Standing& thing) {
           return std::hypot(thing.along - along, thing.away) <=
                  kVisibility.hidden_slope * thing.height + kVisibility.hidden_beside;
         }) >= kModel.sure_points;
}

// Where light falls past the plate, on what lies behind it, in a stripe that does not show the
// plate there. Light and sight meet the plane at places `askew` from each other.
std::optional<Stretch> fallen(const Stretch& off, const std::vector<Stretch>& on, double crossing,
                              double slant) {
  double low = std::min(off[0].away, off[1].away), high = std::max(off[0].away, off[1].away);
  for (const Stretch& piece : on) {
    const auto [from, to] = std::minmax(piece[0].away, piece[1].away);
    if (low < from)
      high = std::min(high, from - kVisibility.askew);
    else
      low = std::max(low, to + kVisibility.askew);
  }
  if (high - low < kVisibility.least_fall) return std::nullopt;
  const double askew = slant > 0 ? kVisibility.askew : -kVisibility.askew;
  const auto place = [&](double away) {
    return PlacePart{crossing + slant * std::max(0.0, away + askew), away};
  };
  return Stretch{place(low), place(high)};
}

Stretch moved(const Stretch& stretch, double outward, double by) {
  return {PlacePart{outward * stretch[0].out + by, stretch[0].away},
          PlacePart{outward * stretch[1].out + by, stretch[1].away}};
}

// Dark stripes beside one that may be hidden may be hidden by the same thing, or in its shadow.
void spread_cover(std::vector<StripeEvidence>& stripes) {
  const auto pass_on = [](const StripeEvidence& from, StripeEvidence& to) {
    to.covered |= from.covered && from.absent && to.absent && to.off.empty();
  };
  for (std::size_t k = 1; k < stripes.size(); ++k) pass_on(stripes[k - 1], stripes[k]);
  for (std::size_t k = stripes.size(); k-- > 1;) pass_on(stripes[k], stripes[k - 1]);
}

// Stripes that leave the plate as far from the seam as others do, elsewhere along it, leave it over
// its side.
void drop_side_edge(std::vector<StripeEvidence>& stripes) {
  const auto beside = [](const EdgeCrossing& edge, const StripeEvidence& other) {
    return std::any_of(other.edges.begin(), other.edges.end(), [&](const EdgeCrossing& its) {
      return std::abs(edge.away - its.away) < kEnds.side_edge &&
             std::abs(edge.along - its.along) > 2 * kEnds.side_edge;
    });
  };
  const std::vector<StripeEvidence> all = stripes;
  for (StripeEvidence& stripe : stripes)
    std::erase_if(stripe.edges, [&](const EdgeCrossing& edge) {
      return std::count_if(all.begin(), all.end(), [&](const StripeEvidence& other) {
               return beside(edge, other);
             }) >= kModel.stripes_in_a_row;
    });
}

// As it counts outward. The light ends before the edge.
EdgeCrossing toward(EdgeCrossing edge, double outward, double shortening_px) {
  edge.along *= outward;
  if (edge.ended) edge.along += shortening_px * edge.pixel;
  edge.way_along *= outward;
  return edge;
}

}  // namespace

std::array<std::vector<StripeEvidence>, 2> plate_evidence(const ScanCloud& cloud,
                                                          const PlateStripes& stripes,
                                                          const Stations& stations, int plate,
                                                          const Scales& scales,
                                                          const SeamFindingSettings& settings) {
  const Collector collector(cloud, stripes, scales.tolerance);
  const std::vector<Standing> standing = collector.standing();
  // What lies nearer to the seam is where a stripe turns to the other plate; what lies farther is
  // the plate's other edge, along the seam.
  const double near = collector.begin() + kVisibility.near_seam;
  const double far = stripes.reach - kVisibility.near_seam;
  // So much of it beside the seam would be seen.
  const double beside = cloud.organised() ? near - kVisibility.near_seam / 2 : 0;
  // The plate is there at least so far before what it is seen by, and is not beyond.
  const double slack = kVisibility.beam * scales.noise + kEnds.half_stripe;

  std::array<std::vector<StripeEvidence>, 2> both;
  for (const Station& station : stations.list) {
    if (!station.known) continue;
    const bool at_seam = station.nearest[plate] <= stations.near[plate];
    Seen seen{at_seam, false, {}, {}, {}};
    bool only_cut = false;  // which says nothing of this plate
    if (station.stripe < 0) {
      if (at_seam) seen.on.push_back({PlacePart{station.along, 0}, PlacePart{station.along, 0}});
    } else {
      const auto& run = stripes.runs[station.stripe];
      seen.on = collector.on(run);
      seen.off = collector.off(cloud.stripes[station.stripe], near);
      seen.shown = at_seam || collector.shows_within(near, run);
      only_cut = collector.shows_only_cut(station.stripe) && !covers(standing, station.along);
      if (only_cut) seen.on.clear(), seen.shown = false;
      for (const bool at_back : {false, true})
        if (const auto edge = edge_crossing(cloud, run, stripes, at_back, scales);
            edge && edge->away > near && edge->away < far)
          seen.edges.push_back(*edge);
    }
    seen.covered = !seen.shown && covers(standing, station.along);

    for (const SeamSide side : {SeamSide::kBegin, SeamSide::kEnd}) {
      const double outward = static_cast<double>(side);
      StripeEvidence evidence;
      evidence.covered = seen.covered;
      const double slant = outward * stations.slant[plate];
      if (!seen.shown && !only_cut)
        evidence.absent = PlacePart{outward * station.along + slant * beside, beside};
      for (const Stretch& on : seen.on) evidence.on.push_back(moved(on, outward, -slack));
      for (const Stretch& off : seen.off) {
        evidence.off.push_back(moved(off, outward, slack));
        if (const auto light = fallen(off, seen.on, outward * station.along, slant))
          evidence.off.push_back(moved(*light, 1, slack));
      }
      for (const EdgeCrossing& edge : seen.edges) {
        evidence.edges.push_back(toward(edge, outward, settings.edge_shortening_px));
        evidence.covered |= edge.occluded && evidence.edges.back().way_along > 0;
      }
      both[side == SeamSide::kEnd].push_back(std::move(evidence));
    }
  }
  for (auto& stripes_toward : both) {
    spread_cover(stripes_toward);
    drop_side_edge(stripes_toward);
  }
  return both;
}

std::vector<StripeEvidence> beside_seam(std::vector<StripeEvidence> evidence, double seam_away) {
  for (StripeEvidence& stripe : evidence) {
    for (auto* stretches : {&stripe.on, &stripe.off})
      for (Stretch& stretch : *stretches)
        for (PlacePart& part : stretch) part.away -= seam_away;
    for (EdgeCrossing& edge : stripe.edges) edge.away -= seam_away;
    if (stripe.absent) stripe.absent->away -= seam_away;
  }
  return evidence;
}

}  // namespace arcstart::seam_finding
