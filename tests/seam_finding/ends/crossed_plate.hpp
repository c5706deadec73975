// A plate that stripes cross at a slant, and what they say of its ends.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "services/seam_finding/coverage/stations.hpp"
#include "services/seam_finding/ends/plate_evidence.hpp"
#include "tests/seam_finding/support/likelihood_moments.hpp"
#include "tests/seam_finding/support/scales.hpp"

namespace arcstart::seam_finding::crossed_plate {

// A plate in z = 0 from x = begin to 100 and y = 0 to 40, its seam along the x axis; stripes every
// 3.6 mm cross it at a slant, thinned out to every fifteenth of their centres a tenth of a
// millimetre apart, and end a pixel's fraction before its edges. next: the height over the plate of
// what a stripe shows next; 0 for nothing.
struct Made {
  ScanCloud cloud;
  JointPlate plate, other;
  Line line{{0, 0, 0}, {1, 0, 0}};
};

// turn: of the edge at its begin, mm farther in for each mm away. cut: by how much a stripe that
// turns over that edge, onto the plate's cut, goes on along the seam for each mm down; mm.
inline Made make(double begin, double slant, double next, unsigned seed, double turn = 0,
                 std::optional<double> cut = {}) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0, 0.02);
  std::uniform_real_distribution<double> phase(0, 0.1);
  Made made;
  made.plate.plane = {Eigen::Vector3d::UnitZ(), 0};
  made.other.plane = {Eigen::Vector3d::UnitY(), 0};
  for (double x = -20; x < 120; x += 3.6) {
    const int stripe = static_cast<int>(made.cloud.stripes.size());
    std::vector<Eigen::Vector3d> centres;  // outward from the seam
    for (double y = phase(engine); y < 40; y += 0.1)
      if (const double along = x - slant * y; along > begin + turn * y && along < 100)
        centres.emplace_back(along + noise(engine), y, noise(engine));
    const auto add = [&](const Eigen::Vector3d& point, int segment, bool end) {
      made.cloud.points.push_back(point);
      made.cloud.origins.push_back({stripe, segment, end, 0, 0.1f * std::hypot(1.0f, 0.3f)});
    };
    const bool turns = cut && !centres.empty() && centres.back().x() < begin + 0.5;
    for (std::size_t i = 0; i < centres.size(); ++i)
      if (i % 15 == 0 || i + 1 == centres.size()) {
        made.plate.points.push_back(made.cloud.size());
        add(centres[i], 0, i == 0 || (i + 1 == centres.size() && !turns));
      }
    if (turns)
      for (double depth = 0.7; depth < 3; depth += 0.7) {
        const double y = centres.back().y();
        add({begin - *cut * depth + noise(engine), y, -depth + noise(engine)}, 0, depth > 2.5);
      }
    if (next != 0 && !centres.empty()) add(centres.back() + Eigen::Vector3d(-1, 1, next), 1, true);
    end_stripe(made.cloud, ScanStripe::Seen::kSeen, {x, 100, 200}, {x, 0, 0});
  }
  return made;
}

inline const Scales kScales = scales_of_test(3.6, 0.5, 0.02);

inline std::array<std::vector<StripeEvidence>, 2> evidence_of(const Made& made,
                                                              double shortening_px) {
  SeamFindingSettings settings;
  settings.edge_shortening_px = shortening_px;
  const PlateStripes stripes =
      plate_stripes(made.cloud, made.plate, made.other, made.line, kScales);
  const Stations stations =
      stations_along(made.cloud, {made.plate, made.other}, made.line, kScales);
  return plate_evidence(made.cloud, stripes, stations, 0, kScales, settings);
}

inline std::vector<StripeEvidence> toward_begin(const Made& made, double shortening_px) {
  return evidence_of(made, shortening_px)[0];
}

struct Edge {
  double along = 0, deviation = 0;
  FootLikelihood likelihood;
};

inline Edge edge_of(const Made& made, SeamSide side, double about, double shortening_px) {
  const double outward = static_cast<double>(side);
  const PlaceGrid grid{outward * about - 10, 0.05, 400};
  Edge edge;
  edge.likelihood = foot_likelihood(evidence_of(made, shortening_px)[side == SeamSide::kEnd], grid,
                                    {0, SeamFindingSettings{}.edge_slope()});
  const PlaceMoments found = moments_of(edge.likelihood, grid);
  edge.along = outward * found.mean;
  edge.deviation = std::hypot(found.deviation, edge.likelihood.deviation);
  return edge;
}

}  // namespace arcstart::seam_finding::crossed_plate
