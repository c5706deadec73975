// Scans of scenes of the wild in closed form: the laser's sheet cut with the scene's triangles,
// what of it the camera sees, as centres pixel by pixel, carried back to base with the calibration
// and the positions that are told. No image, no code of the product beside its messages.
#pragma once

#include <arcstart/profile_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "services/cell_simulator/wild/wild_build.hpp"

namespace arcstart::seam_finding::synthetic {

struct WildScanChoice {
  int downsample = 15;        // M; 1: all points
  double bend_px = 0.5;       // centres that depart so far from a straight line are kept; 0: none
  double end_noise_px = 0.2;  // of a segment's end, along the stripe
  double bend_blur_px = 1.5;  // sigma by which extraction rounds a bend
  double noise_factor = 1;    // on the surfaces' noise
  std::int64_t scan_id = 1'700'000'000'000'000, run_id = 1'699'999'999'000'000, first_seq = 0;
  std::string calibration_id = "simulated";
};

// What the exact geometry says of a seam's end, by this scan's stripes.
struct WildSight {
  enum class Kind { kOutside, kHidden, kBounded, kCrossed };
  bool in_view = false;  // at least three stripes within four spacings of the end, inside the
                         // seam, show both plates within the seam's reach
  int stripes = 0;       // how many do
  int crossings = 0;  // stripes that leave the deciding plate's face over the edge there, and are
                      // seen to
  bool crossed() const { return crossings >= 2; }
  bool in_scan =
      false;  // at least one stripe falls on the seam's line before the end, and one on it
  Kind kind() const {
    return !in_scan    ? Kind::kOutside
           : !in_view  ? Kind::kHidden
           : crossed() ? Kind::kCrossed
                       : Kind::kBounded;
  }
};

struct WildSeamSight {
  WildSight start, end;
};

struct WildScan {
  std::vector<profile_t> profiles;        // one a stripe, in order
  std::vector<std::vector<int>> objects;  // of each profile's points: index in Scene::objects(),
                                          // -1: a reflection or a stray point
  std::vector<WildSeamSight> sights;      // one for each of the truth's seams; of a workpiece scan
};

// The same arguments give the same scan. `scene` is build(wild, kind).
WildScan wild_scan(const cell_simulator::WildScene& wild, const cell_simulator::Scene& scene,
                   cell_simulator::SceneKind kind, const WildScanChoice& choice = {});

// The same, built here.
WildScan wild_scan(const cell_simulator::WildScene& wild, cell_simulator::SceneKind kind,
                   const WildScanChoice& choice = {});

}  // namespace arcstart::seam_finding::synthetic
