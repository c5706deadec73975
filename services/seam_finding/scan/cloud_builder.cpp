#include "services/seam_finding/scan/cloud_builder.hpp"

#include <algorithm>
#include <cmath>

#include "services/seam_finding/scan/scan_limits.hpp"

namespace arcstart::seam_finding {
namespace {

constexpr std::size_t kUsualPoints = 1 << 17;  // room from the begin: moved in no profile's time
constexpr double kFarthest = 1e5;              // mm: a point farther away is damage, too

ScanStripe::Seen seen_in(const profile_t& profile) {
  if (profile.count > 0) return ScanStripe::Seen::kSeen;
  return showed_nothing(profile) ? ScanStripe::Seen::kEmpty : ScanStripe::Seen::kMissing;
}

// Way on the surface that is a pixel along the stripe there: from the neighbour that down-sampling
// left.
float step_at(const profile_t& profile, int i) {
  for (const int j : {i - 1, i + 1}) {
    if (j < 0 || j >= profile.count || profile.segment[j] != profile.segment[i]) continue;
    const float u = profile.u[j] - profile.u[i], v = profile.v[j] - profile.v[i];
    const float x = profile.x[j] - profile.x[i], y = profile.y[j] - profile.y[i],
                z = profile.z[j] - profile.z[i];
    const float pixels = std::sqrt(u * u + v * v);
    if (pixels > 0.5f) return std::sqrt(x * x + y * y + z * z) / pixels;
  }
  return 0;
}

}  // namespace

bool showed_nothing(const profile_t& profile) {
  return profile.why == profile_t::NO_STRIPE || profile.why == profile_t::NONE_CHOSEN ||
         profile.why == profile_t::OUT_OF_RANGE;
}

CloudBuilder::CloudBuilder(std::int64_t first_seq) : next_seq_(first_seq) {
  cloud_.points.reserve(kUsualPoints);
  cloud_.origins.reserve(kUsualPoints);
}

void CloudBuilder::miss_until(std::int64_t seq) {
  for (; next_seq_ < seq && cloud_.stripes.size() < kMostProfiles; ++next_seq_)
    end_stripe(cloud_, ScanStripe::Seen::kMissing);
}

void CloudBuilder::add(const profile_t& profile) {
  if (next_seq_ < 0) next_seq_ = first_seq_by(profile);
  miss_until(profile.seq);
  next_seq_ = profile.seq + 1;
  const int stripe = static_cast<int>(cloud_.stripes.size());
  for (int i = 0; i < profile.count; ++i) {
    const Eigen::Vector3d point(profile.x[i], profile.y[i], profile.z[i]);
    if (point.cwiseAbs().maxCoeff() > kFarthest) continue;
    cloud_.points.push_back(point);
    cloud_.origins.push_back({stripe, profile.segment[i],
                              profile.segment_end[i] != profile_t::CONTINUES, profile.deviation[i],
                              step_at(profile, i)});
  }
  end_stripe(cloud_, seen_in(profile), Eigen::Map<const Eigen::Vector3d>(profile.camera_centre),
             Eigen::Map<const Eigen::Vector3d>(profile.tool_position),
             Eigen::Quaterniond(profile.tool_quaternion[0], profile.tool_quaternion[1],
                                profile.tool_quaternion[2], profile.tool_quaternion[3]));
}

}  // namespace arcstart::seam_finding
