// Joints of plates whose faces lie in one plane or in parallel ones: lap, butt and V-groove. Their
// seam is no plane's intersection; it is drawn through the places where stripes leave one plate for
// the other.
#pragma once

#include "services/seam_finding/model/joint.hpp"
#include "services/seam_finding/model/plate.hpp"
#include "services/seam_finding/model/scales.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

struct FlatSearch {
  bool lap = false, butt = false, v = false;          // wanted
  double parallel = 0.07;                             // between the plates' normals, at most; rad
  double step_min = 1.5, step_max = 12;               // of a lap: the upper plate's thickness; mm
  double gap_max = 4;                                 // of a butt joint; mm
  double half_angle_min = 0.2, half_angle_max = 0.8;  // of a V's slant from the normal; rad
  double width_max = 30;                              // of a V at its top; mm
  int stripes_min = 5;
  double length_min = 10;  // of the seam where both plates were seen; mm
};

// All such joints between the faces and within each of them; with a flaw where something speaks
// against one. The faces' normals point to the sensor. Empty where the way of the search is not
// known.
std::vector<Joint> find_flat_joints(const ScanCloud& cloud, const std::vector<Face>& faces,
                                    const FlatSearch& search, const Scales& scales);

}  // namespace arcstart::seam_finding
