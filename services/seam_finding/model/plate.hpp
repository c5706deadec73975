// A plate as the scan shows it: a face found in the cloud, and its part in a joint.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// A connected piece of a plane, as one side of a plate gives it.
struct Face {
  Plane plane;              // normal of either sign, until turned to the sensor
  bool side_known = true;   // false: turned to the sensor, but its other side may have been seen
  double rms = 0;           // of its points; mm
  double spacing = 0;       // of its points, the wider one where it differs by direction; mm
  std::vector<int> points;  // indices into the cloud, rising
};

// A plate's part in a joint.
struct JointPlate {
  Plane plane;              // normal out of the metal, toward the sensor
  double contact = 6;       // a point so near the seam's line stands for the plate there; mm
  double round = 0;         // edge round, or in a notch: its face begins so far from the line; mm
  std::vector<int> points;  // indices into the cloud, rising
  // In the plate, away from the seam; zero: toward the side that the other plate faces, as where
  // the two form a hollow.
  Eigen::Vector3d away = Eigen::Vector3d::Zero();
};

// The points but for pieces of a stripe that are so short that chance may lay them on a plate:
// fewer than three points in a row, or two at a segment's end. All of a cloud without stripes.
std::vector<int> without_fragments(const ScanCloud& cloud, const std::vector<int>& points);

// In a plate, away from the seam. Unit.
Eigen::Vector3d away_from_seam(const JointPlate& plate, const JointPlate& other);

}  // namespace arcstart::seam_finding
