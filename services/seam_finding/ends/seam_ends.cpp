#include "services/seam_finding/ends/seam_ends.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/order_statistics.hpp"
#include "services/seam_finding/coverage/parallel_stations.hpp"
#include "services/seam_finding/ends/constants.hpp"
#include "services/seam_finding/ends/end_distribution.hpp"
#include "services/seam_finding/ends/foot_likelihood.hpp"
#include "services/seam_finding/ends/plate_evidence.hpp"
#include "services/seam_finding/gaps/constants.hpp"
#include "services/seam_finding/gaps/root_gap.hpp"

namespace arcstart::seam_finding {
namespace {

// What the scan shows of a plate's ends, along its line.
struct PlateSight {
  Line line;
  PlateBend bend, seam;                                 // of the plate, and of the seam in it
  double height = 0;                                    // over the seam, of its line; mm
  std::array<std::vector<StripeEvidence>, 2> evidence;  // toward the begin and the end

  // Places of the seam on the plate's own line.
  double own(const Line& seam_line, double along) const {
    const double place = line.along(seam_line.at(along));
    // What lies over the seam on a bent plate lies over it square to the bend.
    return place - height * bend.slope_at(place);
  }
};

std::array<PlateSight, 2> sights_of(const ScanCloud& cloud, const Joint& joint,
                                    const Scales& scales, const SeamFindingSettings& settings) {
  std::array<Stations, 2> stations = {joint.coverage.stations, joint.coverage.stations};
  if (joint.parallel) stations = stations_by_edge(cloud, joint, scales);
  const auto stripes_of = [&](int j) {
    return plate_stripes(cloud, joint.plates[j], joint.plates[1 - j],
                         joint.parallel ? joint.parallel->edges[j] : joint.line, scales);
  };
  std::array<PlateStripes, 2> stripes = {stripes_of(0), stripes_of(1)};
  std::array<PlateSight, 2> sights;
  for (int j = 0; j < 2; ++j) {
    PlateStripes& own = stripes[j];
    if (joint.type == JointType::kOutsideCorner)
      own.cut = std::min(kModel.widest_cut, own.reach - kVisibility.near_seam);
    const Line& line = own.line;
    PlateSight& sight = sights[j];
    if (joint.parallel) {
      for (Station& station : stations[j].list)
        station.along = line.along(joint.line.at(station.along));
      sight.height = own.plate.plane.normal.dot(line.point - joint.line.point);
    } else {
      sight.seam = stripes[1 - j].bend.times(1 / own.other.plane.normal.dot(own.away));
    }
    sight.line = line, sight.bend = own.bend;
    sight.evidence = plate_evidence(cloud, own, stations[j], j, scales, settings);
  }
  return sights;
}

using Gaps = std::vector<std::optional<RootGap>>;

// So far from the seam the foot of a plate lies that stands off the other, near an end.
RootGap gap_near(const Gaps& gaps, const Stations& stations, double end) {
  std::vector<double> widths, deviations;
  for (const Station& station : stations.list) {
    if (station.stripe < 0 || std::abs(station.along - end) > kModel.beside_seam) continue;
    if (const auto& gap = gaps[station.stripe])
      widths.push_back(gap->width), deviations.push_back(gap->deviation);
  }
  if (static_cast<int>(widths.size()) < kModel.stripes_in_a_row) return {};
  return {median(widths), median(deviations)};
}

// Of both plates, near an end; they are looked for where they move an end, and only once.
class RootGaps {
 public:
  RootGaps(const ScanCloud& cloud, const Joint& joint) : cloud_(cloud), joint_(joint) {}

  std::array<RootGap, 2> near(double end) {
    // A corner's outer edges are no plates' feet.
    if (joint_.parallel || joint_.type == JointType::kOutsideCorner || !cloud_.organised())
      return {};
    if (!gaps_)
      gaps_ = {root_gaps(cloud_, joint_.plates, joint_.line, 0),
               root_gaps(cloud_, joint_.plates, joint_.line, 1)};
    std::array<RootGap, 2> near;
    for (int j = 0; j < 2; ++j) near[j] = gap_near((*gaps_)[j], joint_.coverage.stations, end);
    near[near[0].width > near[1].width ? 1 : 0] = {};  // one stands off
    // What cannot be told from none mostly is none: plates touch.
    for (RootGap& gap : near)
      if (gap.width < kEnds.least_gap) gap = {0, gap.width / 2};
    return near;
  }

 private:
  const ScanCloud& cloud_;
  const Joint& joint_;
  std::optional<std::array<Gaps, 2>> gaps_;
};

EndVisibility visibility_of(const std::array<FootLikelihood, 2>& plates,
                            const std::vector<EndMode>& modes, const Scales& scales) {
  if (modes[0].weight < 1 - kEnds.never) return EndVisibility::kNotDetermined;
  if (modes[0].variance <= std::pow(kEnds.seen_spacings * scales.spacing, 2))
    return EndVisibility::kSeen;
  return plates[0].occluded || plates[1].occluded ? EndVisibility::kHidden
                                                  : EndVisibility::kNotDetermined;
}

// Of all modes, about the likeliest; mm2.
double whole_variance(const std::vector<EndMode>& modes) {
  double variance = 0;
  for (const EndMode& mode : modes)
    variance += mode.weight * (mode.variance + std::pow(mode.out - modes[0].out, 2));
  return variance;
}

// As far out as the plate was seen from `along` on, both on the seam's line.
double farthest_seen(const PlateSight& sight, const Line& seam_line, double along, bool begin) {
  const double outward = begin ? -1 : 1;
  double farthest = outward * sight.line.along(seam_line.at(along));
  for (const StripeEvidence& stripe : sight.evidence[begin ? 0 : 1])
    for (const Stretch& stretch : stripe.on)
      farthest = std::max({farthest, stretch[0].out, stretch[1].out});
  return outward * seam_line.along(sight.line.at(outward * farthest));
}

SeamEnd end_at(const Joint& joint, const std::array<PlateSight, 2>& sights, RootGaps& gaps,
               SeamSide side, const Scales& scales, const SeamFindingSettings& settings) {
  const bool begin = side == SeamSide::kBegin;
  const double outward = begin ? -1 : 1;
  SeamEnd end;
  end.along = begin ? joint.coverage.begin : joint.coverage.end;
  end.variance = scales.spacing * scales.spacing / 12;
  end.visibility = EndVisibility::kOutside;
  if (begin ? joint.coverage.begins_outside : joint.coverage.ends_outside) return end;

  // Not beyond the seam's middle: there its other end may be seen.
  const double half = (joint.coverage.end - joint.coverage.begin) / 2;
  PlaceGrid grid;
  grid.step = kEnds.grid_step;
  grid.first = outward * end.along - std::min(half, kEnds.inside);
  // Where something lies across the seam, both plates may go on behind it.
  const auto seen = [&](int j) { return farthest_seen(sights[j], joint.line, end.along, begin); };
  const double last = std::min(seen(0), seen(1)) + kEnds.outside;
  grid.count = static_cast<int>((last - grid.first) / grid.step);
  std::array<FootLikelihood, 2> plates;
  for (int j = 0; j < 2; ++j) {
    // On the plate's own line, where it lies beside the seam's.
    const PlateSight& sight = sights[j];
    PlaceGrid own = grid;
    const double place = sight.own(joint.line, end.along);
    own.first += outward * (place - end.along);
    // From the seam as it is bent there, and square to it.
    const SquareEdge square{-outward * sight.seam.slope_at(place), settings.edge_slope()};
    const auto at_distance = [&](double away) {
      return foot_likelihood(
          beside_seam(sight.evidence[begin ? 0 : 1], sight.seam.at(place) + away), own, square);
    };
    plates[j] = at_distance(0);
    // A plate that stands off the seam ends there where its foot does.
    if (std::abs(plates[j].slope - square.slope) * kGaps.widest < kEnds.grid_step) continue;
    const RootGap gap = gaps.near(end.along)[j];
    if (gap.width > 0) plates[j] = at_distance(gap.width);
    plates[j].deviation = std::hypot(plates[j].deviation, plates[j].slope * gap.deviation);
  }
  const std::vector<EndMode> modes = seam_end_modes(plates, grid);
  if (modes.empty()) {
    end.visibility = EndVisibility::kNotDetermined;
    return end;
  }
  end.along = outward * modes[0].out;
  end.variance = modes[0].variance;
  end.by_edges = end.variance < std::pow(kEnds.by_edges * scales.spacing, 2);
  end.visibility = visibility_of(plates, modes, scales);
  if (end.visibility == EndVisibility::kNotDetermined) end.variance = whole_variance(modes);
  if (modes.size() > 1 && modes[1].weight > kEnds.never) {
    end.second = outward * modes[1].out;
    end.second_weight = modes[1].weight;
  }
  return end;
}

}  // namespace

std::array<SeamEnd, 2> find_seam_ends(const ScanCloud& cloud, const Joint& joint,
                                      const Scales& scales, const SeamFindingSettings& settings) {
  const auto sights = sights_of(cloud, joint, scales, settings);
  RootGaps gaps(cloud, joint);
  return {end_at(joint, sights, gaps, SeamSide::kBegin, scales, settings),
          end_at(joint, sights, gaps, SeamSide::kEnd, scales, settings)};
}

}  // namespace arcstart::seam_finding
