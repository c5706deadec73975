// What the stages of reconstruction hand to each other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "services/reconstruction/empty_profile.hpp"

namespace arcstart::reconstruction {

// Which image a stripe, and then its profile, comes from.
struct StripeSource {
  std::int64_t utime = 0;  // middle of the exposure; us
  std::int64_t run_id = 0;
  std::int64_t seq = 0;
  std::int64_t scan_id = 0;  // 0 outside a scan
  std::int32_t scan_index = -1;
};

// As received from extraction, whose own Stripe is another: one program may hold both.
struct ReceivedCentre {
  float u = 0, v = 0;        // distorted, as seen; px
  float deviation = 0;       // across the stripe; px, 0 where not measured
  std::int16_t segment = 0;  // centres of a segment are contiguous
  // Why its segment ends here, as in stripe_t and profile_t: 0 where it continues.
  std::int8_t segment_end = 0;
};

struct ReceivedStripe {
  StripeSource source;
  int sensor_width = 0, sensor_height = 0;  // px
  std::vector<ReceivedCentre> centres;      // the chosen ones
  EmptyProfile why = EmptyProfile::kNone;   // there are none
  std::string empty;                        // the same in extraction's words
};

struct ProfilePoint {
  Eigen::Vector3d position;  // in base; mm
  ReceivedCentre centre;     // that it comes from
  double deviation = 0;      // standard deviation across the stripe; mm, 0 where not measured
};

struct Profile {
  StripeSource source;
  std::vector<ProfilePoint> points;
  RigidTransform T_base_tool = RigidTransform::Identity();  // at utime + time_offset
  Eigen::Vector3d camera_centre = Eigen::Vector3d::Zero();  // in base; mm
  std::string calibration_id;                               // empty for none
  EmptyProfile why = EmptyProfile::kNone;                   // there are no points
  std::string empty;                                        // the same in words
};

}  // namespace arcstart::reconstruction
