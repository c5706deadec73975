// What a cloud can show: its resolution and its noise, measured on the cloud itself.
#pragma once

#include "services/seam_finding/model/scan_cloud.hpp"

namespace arcstart::seam_finding {

// What is the finest detail that the cloud can show, measured on the cloud itself.
struct Sampling {
  double spacing =
      0;  // between stripes while the tool moves, in an unorganised cloud between points; mm
  double step = 0;   // between points along a stripe, where it is wide (the ninth tenth); 0 without
                     // stripes; mm
  double pitch = 0;  // the same, the median; mm
  double noise = 0;  // standard deviation of the points across their surface; mm
};

Sampling measure_sampling(const ScanCloud& cloud);

}  // namespace arcstart::seam_finding
