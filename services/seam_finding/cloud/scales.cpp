#include "services/seam_finding/cloud/scales.hpp"

#include <algorithm>

#include "services/seam_finding/cloud/constants.hpp"

namespace arcstart::seam_finding {

Scales scales_of(const ScanCloud& cloud, const Sampling& sampling, double tolerance_mm) {
  Scales scales;
  scales.spacing = sampling.spacing;
  scales.noise = std::max(kCloud.least_noise, sampling.noise);
  scales.tolerance = tolerance_mm > 0 ? tolerance_mm
                                      : std::clamp(kFit.on_plane * sampling.noise,
                                                   kCloud.least_tolerance, kCloud.most_tolerance);
  scales.connection =
      std::max(4.0, cloud.organised() ? 2 * std::max(sampling.spacing, sampling.pitch)
                                      : 4 * sampling.spacing);
  // A stripe that crosses the seam has a point within one pitch of it on either plate.
  scales.contact = std::max(
      {6.0, 3 * scales.tolerance,
       cloud.organised() ? kCloud.contact_pitches * sampling.pitch : 4 * sampling.spacing});
  return scales;
}

}  // namespace arcstart::seam_finding
