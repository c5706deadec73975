#include "services/seam_finding/scan/covariance_message.hpp"

#include <Eigen/Geometry>

#include "services/seam_finding/answer/calibration_covariance.hpp"
#include "services/seam_finding/scan/clock_share.hpp"

namespace arcstart::seam_finding {
namespace {

bool has_points(const profile_t& profile) { return profile.count > 0; }

// mm/s; from the profiles before and behind, 0 where there are none.
Eigen::Vector3d velocity_at(const std::vector<profile_t>& profiles, std::size_t k) {
  std::size_t before = k, behind = k;
  if (k > 0 && has_points(profiles[k - 1])) --before;
  if (k + 1 < profiles.size() && has_points(profiles[k + 1])) ++behind;
  const auto microseconds = profiles[behind].utime - profiles[before].utime;
  if (microseconds <= 0) return Eigen::Vector3d::Zero();
  return (Eigen::Map<const Eigen::Vector3d>(profiles[behind].tool_position) -
          Eigen::Map<const Eigen::Vector3d>(profiles[before].tool_position)) *
         (1e6 / static_cast<double>(microseconds));
}

// How the point of the scan was seen that lies nearest to the place. The scan has one.
SeenPoint seen_near(const CollectedScan& scan, const Eigen::Vector3d& place) {
  double nearest = -1;
  SeenPoint seen;
  std::size_t nearest_profile = 0;
  for (std::size_t k = 0; k < scan.profiles.size(); ++k) {
    const profile_t& profile = scan.profiles[k];
    for (int i = 0; i < profile.count; ++i) {
      // Component by component: most of a scan's points end with the first.
      const double x = profile.x[i] - place.x();
      if (nearest >= 0 && x * x >= nearest) continue;
      const double y = profile.y[i] - place.y(), z = profile.z[i] - place.z();
      const double distance = x * x + y * y + z * z;
      if (nearest >= 0 && distance >= nearest) continue;
      nearest = distance;
      nearest_profile = k;
      seen.u = profile.u[i], seen.v = profile.v[i];
    }
  }
  const profile_t& profile = scan.profiles[nearest_profile];
  const double* q = profile.tool_quaternion;
  seen.T_base_tool.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  seen.T_base_tool.translation() = Eigen::Map<const Eigen::Vector3d>(profile.tool_position);
  seen.velocity = velocity_at(scan.profiles, nearest_profile);
  return seen;
}

}  // namespace

void fill_in_calibration_covariance(seam_t& seam, const CollectedScan& scan,
                                    const Calibration* calibration) {
  if (seam.verdict != seam_t::FOUND) return;
  const auto undetermined = [&](const char* why) {
    seam.remark += std::string("systematic deviations not determined: ") + why;
  };
  if (calibration == nullptr || calibration->id != seam.calibration_id)
    return undetermined("the scan's calibration was not heard of here");
  if (calibration->covariance.empty()) return undetermined("the calibration has no covariance");
  const auto systematic = [&](const double* place) {
    const SeenPoint seen = seen_near(scan, Eigen::Map<const Eigen::Vector3d>(place));
    auto covariance = calibration_covariance(*calibration, seen);
    const Eigen::Vector3d displaced = clock_doubt(scan.state) * seen.velocity;
    if (covariance) *covariance += displaced * displaced.transpose();
    return covariance;
  };
  const auto start = systematic(seam.start), end = systematic(seam.end);
  if (!start || !end) return undetermined("the calibration's covariance is none");
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      seam.start_systematic[row][column] = (*start)(row, column);
      seam.end_systematic[row][column] = (*end)(row, column);
    }
}

}  // namespace arcstart::seam_finding
