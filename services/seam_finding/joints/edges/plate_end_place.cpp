#include "services/seam_finding/joints/edges/plate_end_place.hpp"

#include <algorithm>
#include <cmath>

#include "services/seam_finding/joints/constants.hpp"

namespace arcstart::seam_finding {

int last_on_plate(const Transition& transition, int plate) {
  return plate == 0 ? transition.last : transition.first;
}

int follower(const ScanCloud& cloud, const Transition& transition, int plate) {
  const int own = last_on_plate(transition, plate);
  int next = last_on_plate(transition, 1 - plate);
  if (!transition.between.empty())
    next = plate == 0 ? transition.between.front() : transition.between.back();
  const bool joined =
      cloud.organised() && cloud.origins[next].segment == cloud.origins[own].segment;
  return joined ? next : -1;
}

LinePlace end_place(const ScanCloud& cloud, const Transition& transition, const PlateFrame& frame,
                    int plate, int next, double pitch_mm) {
  const int own = last_on_plate(transition, plate);
  const Eigen::Vector3d p = frame.of(cloud.points[own]);
  const double outward = plate == 0 ? 1 : -1;
  LinePlace place{p.x(), p.y(), 0, kJoints.jump_deviation};
  if (cloud.origins[own].segment_end) return place;
  double step = pitch_mm;
  if (next >= 0) step = std::abs(frame.of(cloud.points[next]).y() - p.y());
  place.across += outward * step / 2;
  place.deviation = std::max(kJoints.cut_deviation, step / std::sqrt(12.0));
  return place;
}

}  // namespace arcstart::seam_finding
