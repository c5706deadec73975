#include "services/seam_finding/interruption.hpp"

#include "services/seam_finding/plate_stripes.hpp"

namespace arcstart {
namespace {

constexpr double kNearSeam = 3, kBeside = 20;  // in a plate, where it would be; mm
constexpr double kReach = 60;                  // what stands before a seam lies so near it; mm
constexpr double kStandsBefore = 3;            // mm
constexpr int kLeastSeen = 3;                  // points

struct Between {
  int before = 0;  // points before both plates
  int past = 0;    // points seen through where a plate is missing
};

Between look(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates, const Line& line,
             const Stations& stations, const Station& station, double tolerance) {
  Between between;
  const ScanStripe& stripe = cloud.stripes[station.stripe];
  std::array<int, 2> past{};
  for (int i = stripe.first; i < stripe.first + stripe.count; ++i) {
    const Eigen::Vector3d& point = cloud.points[i];
    between.before += plates[0].plane.signed_distance(point) > kStandsBefore &&
                      plates[1].plane.signed_distance(point) > kStandsBefore &&
                      line.distance(point) < kReach;
    for (int j = 0; j < 2; ++j) {
      if (station.nearest[j] <= stations.near[j]) continue;
      const auto through = seen_through(cloud, plates[j].plane, i, 2 * tolerance);
      if (!through) continue;
      const double r = away_from_seam(plates[j], plates[1 - j]).dot(*through - line.point);
      past[j] += r > kNearSeam && r < kBeside;
    }
  }
  between.past = std::max(past[0], past[1]);
  return between;
}

}  // namespace

bool hidden_between(const ScanCloud& cloud, const std::array<JointPlate, 2>& plates,
                    const Line& line, const Stations& stations, int from, int to,
                    double tolerance) {
  bool hidden = false;
  for (int k = from + 1; k < to; ++k) {
    const Station& station = stations.list[k];
    if (station.stripe < 0) return false;
    if (!station.known || stations.both(station)) continue;
    const Between between = look(cloud, plates, line, stations, station, tolerance);
    if (between.past >= kLeastSeen) return false;
    hidden |= between.before >= kLeastSeen;
  }
  return hidden;
}

}  // namespace arcstart
