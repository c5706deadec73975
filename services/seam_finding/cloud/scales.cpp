#include "services/seam_finding/cloud/scales.hpp"

#include <algorithm>

namespace arcstart::seam_finding {
namespace {

constexpr double kLeastTolerance = 0.6;  // mm
constexpr double kLeastNoise = 0.01;     // mm
constexpr double kMostTolerance = 6;     // mm
constexpr double kNoiseTolerance = 4;    // tolerance over noise
constexpr double kPitches = 1.3;         // contact over the points' distance along a stripe

}  // namespace

Scales scales_of(const ScanCloud& cloud, const Sampling& sampling, double tolerance_mm) {
  Scales scales;
  scales.spacing = sampling.spacing;
  scales.noise = std::max(kLeastNoise, sampling.noise);
  scales.tolerance = tolerance_mm > 0 ? tolerance_mm
                                      : std::clamp(kNoiseTolerance * sampling.noise,
                                                   kLeastTolerance, kMostTolerance);
  scales.connection =
      std::max(4.0, cloud.organised() ? 2 * std::max(sampling.spacing, sampling.pitch)
                                      : 4 * sampling.spacing);
  // A stripe that crosses the seam has a point within one pitch of it on either plate.
  scales.contact = std::max({6.0, 3 * scales.tolerance,
                             cloud.organised() ? kPitches * sampling.pitch : 4 * sampling.spacing});
  return scales;
}

}  // namespace arcstart::seam_finding
