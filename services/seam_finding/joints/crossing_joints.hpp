// Every pair of faces that cross and may be a joint, ranked: angle (Eq. 6), concavity or, outside
// a corner, convexity, and contact along the line.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "services/seam_finding/model/coverage.hpp"
#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/joint_type.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

struct JointSearch {
  JointType type = JointType::kTee;  // that or a corner
  double angle = 1.5708;             // theta of Eq. 6, between the plates; rad
  double angle_tolerance = 0.35;     // epsilon of Eq. 6; rad
  double contact = 6;                // a plate is at the seam where its points come so near; mm
  double tolerance = 0.5;            // of a point's distance from its plane; mm
  int stripes_min = 5;
  double length_min = 15;  // of the seam where both plates were seen; mm
  CourseSearch course;
};

// Turns the planes' normals to the side they were seen from. Returns for each whether that is
// certain: it is not where a viewpoint that is only assumed, or is the same for all of a cloud,
// lies nearly in the plane.
std::vector<bool> turn_to_sensor(const ScanCloud& cloud, std::vector<Face>& faces);

// All pairs whose planes meet under the angle and touch, best first; those with a flaw behind those
// without. `left`: the points that are not background.
std::vector<Joint> rank_joints(const ScanCloud& cloud, const std::vector<int>& left,
                               const std::vector<Face>& faces, const std::vector<bool>& certain,
                               const JointSearch& search);

// Best first; those with a flaw behind those without.
void sort_by_score(std::vector<Joint>& joints);

// The same seam, found on two pieces of a plate.
bool same_seam(const Joint& a, const Joint& b, double tolerance_mm);

}  // namespace arcstart::seam_finding
