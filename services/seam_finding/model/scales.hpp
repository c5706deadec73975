// What counts as near in a cloud, from what the cloud itself shows.
#pragma once

namespace arcstart::seam_finding {

// All in mm.
struct Scales {
  double tolerance;   // of a point's distance from its plane
  double connection;  // between points of one piece
  double contact;     // of a plate's points to the seam's line
  double spacing;     // between stripes, or between the points of a cloud without
  double noise;       // standard deviation of a point
};

}  // namespace arcstart::seam_finding
