// What counts as near in a cloud, from what the cloud itself shows.
#pragma once

namespace arcstart::seam_finding {

// All in mm.
struct Scales {
  double tolerance = 0.5;  // of a point's distance from its plane
  double connection = 8;   // between points of one piece
  double contact = 6;      // of a plate's points to the seam's line
  double spacing = 1;      // between stripes, or between the points of a cloud without
  double noise = 0.05;     // of the points across their surface, standard deviation
};

}  // namespace arcstart::seam_finding
