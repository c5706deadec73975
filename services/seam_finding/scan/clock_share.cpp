#include "services/seam_finding/scan/clock_share.hpp"

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <arcstart/seam_t.hpp>
#include <cmath>

#include "common/order_statistics.hpp"

namespace arcstart::seam_finding {
namespace {

// Of what is allowed, a displacement that is possible, as after a clock was set, but not certain:
// the seam's deviation contains it.
constexpr double kDoubtMax = 10;

}  // namespace

double clock_doubt(const scan_t& state) {
  return state.clock_bound < 0 ? 0 : std::abs(state.clock_difference) + state.clock_bound;
}

double speed_of(const CollectedScan& scan) {
  std::vector<double> speeds;
  for (std::size_t k = 1; k < scan.profiles.size(); ++k) {
    const profile_t& before = scan.profiles[k - 1];
    const profile_t& after = scan.profiles[k];
    if (before.count == 0 || after.count == 0 || after.utime <= before.utime) continue;
    const double way = (Eigen::Map<const Eigen::Vector3d>(after.tool_position) -
                        Eigen::Map<const Eigen::Vector3d>(before.tool_position))
                           .norm();
    speeds.push_back(way * 1e6 / static_cast<double>(after.utime - before.utime));
  }
  return quantile(speeds, 0.9);
}

ScanRefusal clock_refusal(const CollectedScan& scan, double allowed_mm) {
  if (scan.state.clock_bound < 0) return {};
  const double surely =
      std::max(0.0, std::abs(scan.state.clock_difference) - scan.state.clock_bound);
  const double speed = speed_of(scan);
  if (surely * speed <= allowed_mm && clock_doubt(scan.state) * speed <= kDoubtMax * allowed_mm)
    return {};
  return refuse_scan(
      seam_t::CLOCKS_DIFFER,
      fmt::format("up to {:.1f} ms, by which it is displaced by {:.1f} mm at "
                  "{:.0f} mm/s",
                  clock_doubt(scan.state) * 1e3, clock_doubt(scan.state) * speed, speed));
}

std::string clock_remark(const CollectedScan& scan, double allowed_mm) {
  if (scan.state.clock_bound < 0)
    return "the clocks that stamp images and positions were not compared (robot_pose answered no "
           "CLOCK_PROBE); ";
  const double perhaps = clock_doubt(scan.state) * speed_of(scan);
  if (perhaps <= allowed_mm) return "";
  return fmt::format("the clocks that stamp images and positions may displace it by {:.2f} mm; ",
                     perhaps);
}

}  // namespace arcstart::seam_finding
