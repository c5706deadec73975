// The places along a line at which a scan looked at both plates.
#pragma once

#include <array>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/scan_cloud.hpp"

namespace arcstart {

// A plate's part in a joint.
struct JointPlate {
  Plane plane;              // normal out of the metal, toward the sensor
  double contact = 6;       // a point so near the seam's line stands for the plate there; mm
  std::vector<int> points;  // indices into the cloud, rising
  // In the plate, away from the seam; zero: toward the side that the other plate faces, as where
  // the two form a hollow.
  Eigen::Vector3d away = Eigen::Vector3d::Zero();
};

// The points but for pieces of a stripe that are so short that chance may lay them on a plate:
// fewer than three points in a row, or two at a segment's end. All of a cloud without stripes.
std::vector<int> without_scraps(const ScanCloud& cloud, const std::vector<int>& points);

struct CourseSearch {
  double spacing = 1;      // between stripes, or points of an unorganised cloud; mm
  double tolerance = 0.5;  // of a point's distance from its plate; mm
  double bridge = 20;      // a seam goes on behind an interruption no longer than this; mm
};

// In a plate, away from the seam. Unit.
Eigen::Vector3d away_from_seam(const JointPlate& plate, const JointPlate& other);

// A stripe that crosses the line, or without stripes a piece of the line.
struct Station {
  double along = 0;  // where it crosses; mm
  std::array<double, 2>
      nearest{};      // distance of each plate's nearest point from the line, infinite for none; mm
  bool known = true;  // false: the stripe is missing, or spoilt
  int stripe = -1;    // index, -1 in a cloud without stripes
};

struct Stations {
  std::vector<Station> list;  // in order of their places
  // A plate is at a station where its nearest point is no farther from the line than a stripe's
  // points are from each other; else the stripe leaves the plate before it crosses the seam. mm
  std::array<double, 2> near{};
  // At which stripes cross each plate: mm along the line for each mm away from it.
  std::array<double, 2> slant{};

  bool both(const Station& station) const {
    return station.nearest[0] <= near[0] && station.nearest[1] <= near[1];
  }
};

// A station for every stripe of the scan, also those that cross the line where no plate is, in the
// order of their places. A stripe's crossing is extrapolated from the points beside the line, with
// the slant at which stripes cross the plates; where it shows no plate, it is carried there by the
// tool's way from the nearest stripe that does. A cloud without stripes has one for every `spacing`
// of the line.
Stations stations_along(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                        const Line& line, const CourseSearch& search);

}  // namespace arcstart
