#include "services/seam_finding/ends/seam_ends.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "services/seam_finding/coverage/parallel_stations.hpp"
#include "services/seam_finding/ends/constants.hpp"
#include "services/seam_finding/ends/end_distribution.hpp"
#include "services/seam_finding/ends/foot_likelihood.hpp"
#include "services/seam_finding/ends/plate_evidence.hpp"

namespace arcstart::seam_finding {
namespace {

// What the scan shows of a plate's ends, along its line.
struct PlateSight {
  Line line;
  std::array<std::vector<StripeEvidence>, 2> evidence;  // toward the begin and the end
};

std::array<PlateSight, 2> sights_of(const ScanCloud& cloud, const Joint& joint,
                                    const Scales& scales, const SeamFindingSettings& settings) {
  std::array<PlateSight, 2> sights;
  std::array<Stations, 2> stations;
  if (joint.parallel) stations = stations_by_edge(cloud, joint, scales);
  for (int j = 0; j < 2; ++j) {
    const Line& line = joint.parallel ? joint.parallel->edges[j] : joint.line;
    for (Station& station : stations[j].list)
      station.along = line.along(joint.line.at(station.along));
    const PlateStripes stripes =
        plate_stripes(cloud, joint.plates[j], joint.plates[1 - j], line, scales);
    sights[j] = {
        line, plate_evidence(cloud, stripes, joint.parallel ? stations[j] : joint.coverage.stations,
                             j, scales, settings)};
  }
  return sights;
}

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

SeamEnd end_at(const Joint& joint, const std::array<PlateSight, 2>& sights, SeamSide side,
               const Scales& scales, const SeamFindingSettings& settings) {
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
  grid.count = static_cast<int>((outward * end.along + kEnds.outside - grid.first) / grid.step);
  std::array<FootLikelihood, 2> plates;
  for (int j = 0; j < 2; ++j) {
    // On the plate's own line, where it lies beside the seam's.
    PlaceGrid own = grid;
    own.first += outward * (sights[j].line.along(joint.line.at(end.along)) - end.along);
    plates[j] = foot_likelihood(sights[j].evidence[begin ? 0 : 1], own, settings.edge_slope());
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
  return {end_at(joint, sights, SeamSide::kBegin, scales, settings),
          end_at(joint, sights, SeamSide::kEnd, scales, settings)};
}

}  // namespace arcstart::seam_finding
