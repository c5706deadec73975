// Scans of a scene of boxes on an uneven table, in closed form: a fan of laser rays in each
// stripe's plane, the first box it meets, and whether the camera sees that point. A segment's ends
// lie between the pixels' rays, where the light ends, as far off as those found in images. No
// image, no code of the product beside its cloud.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/cloud/sampling.hpp"

namespace arcstart::seam_finding::synthetic {

// A box with its own frame; its faces are at +-half_size. What lies before a cut is missing.
struct Box {
  Eigen::Isometry3d T_base_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half_size = Eigen::Vector3d::Ones();
  std::vector<Plane> cuts;  // in its frame
};

struct Scene {
  std::vector<Box> boxes;
  double table_waves = 0.4;  // the table's height goes up and down by so much; mm
  bool table = true;
  // Truth where there is a joint.
  std::string joint_type = "tee";
  Eigen::Vector3d start{0, 0, 0}, end{0, 0, 0};
  Eigen::Vector3d normals[2] = {{0, 0, 1},
                                {0, 1, 0}};  // of base plate and upright, out of the metal
};

struct SceneChoice {
  // tee; inside_corner, whose base plate ends behind the upright; outside_corner, mitred; lap;
  // butt, with a gap of 1 mm; v, of 60 deg with a root gap of 2 mm.
  std::string joint = "tee";
  bool workpiece = true;
  bool tool = false;         // left lying on the table beside the workpiece
  bool big_box = false;      // larger than the workpiece, beside it
  bool box_on_base = false;  // small, on the base plate's open side, near the start or over it
  double base_overhang =
      0;  // the base plate begins so much earlier (negative: later) than the upright; mm
  double tilt_deg = 90;  // between upright and base
  double root_gap = 0;   // of a tee under the upright, along it, of a lap under the upper plate; mm
  bool lone_plate = false;  // no upright
};
Scene make_scene(const SceneChoice& choice, std::uint64_t seed);

struct ScanChoice {
  double pitch = 3.6;   // tool's way between stripes; mm
  int downsample = 15;  // M: every M-th centre of a segment, and its last
  bool bends = false;   // also those at which it turns by more than 20 deg
  double noise =
      0.1;  // of each point along the laser's beam, as an error across the stripe moves it; mm
  double end_noise = 0.2;       // of a segment's end along the stripe; px
  double stripe_noise = 0.02;   // of the tool's position, common to a stripe; mm, each axis
  double from = -35, to = 150;  // of the tool along the search; mm
  double lean_deg = 38;         // of the optical axis over the open side
  double outliers = 0.002;      // share of points that lie anywhere up to 20 mm off
};
// Whether the stripe through the seam's start is lit and in sight there on both plates of a tee:
// wherever it runs no nearer than 2 mm to the seam and no farther than 4.
bool start_in_sight(const Scene& scene, const ScanChoice& choice);
// What a point truly lies on.
enum class Truth : char { kTable, kBox, kOutlier };
struct SyntheticScan {
  ScanCloud cloud;
  std::vector<Truth> truth;  // one a point
};
SyntheticScan make_scan(const Scene& scene, const ScanChoice& choice, std::uint64_t seed);

}  // namespace arcstart::seam_finding::synthetic
