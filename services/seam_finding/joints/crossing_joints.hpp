// Every pair of faces that cross and may be a joint, ranked: angle (Eq. 6), concavity or, outside
// a corner, convexity, and contact along the line.
#pragma once

#include <vector>

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/joint_type.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// theta and epsilon of Eq. 6; rad.
struct WantedAngle {
  double angle = 0, tolerance = 0;
};
WantedAngle wanted_angle(JointType type, const SeamFindingSettings& settings);

// The planes' normals on the side they were seen from, and for each face whether that side is
// known: it is not where a viewpoint that is only assumed, or is the same for all of a cloud, lies
// nearly in the plane.
std::vector<Face> turned_to_sensor(const ScanCloud& cloud, std::vector<Face> faces);

// All pairs whose planes meet under the angle of that type, a tee or a corner, and touch; with a
// flaw where something speaks against one. `left`: the points that are not background.
std::vector<Joint> find_crossing_joints(const ScanCloud& cloud, const std::vector<int>& left,
                                        const std::vector<Face>& faces, JointType type,
                                        const Scales& scales, const SeamFindingSettings& settings);

// The same seam, found on two pieces of a plate.
bool same_seam(const Joint& a, const Joint& b, double tolerance_mm);

}  // namespace arcstart::seam_finding
