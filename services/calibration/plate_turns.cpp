#include "services/calibration/plate_turns.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace arcstart {
namespace {

double angle(const Eigen::Matrix3d& rotation) { return Eigen::AngleAxisd(rotation).angle(); }

// The plate turned about its middle, as a transform of its points.
RigidTransform turned_plate(const Plate& plate, int turns) {
  RigidTransform result = RigidTransform::Identity();
  result.linear() =
      Eigen::AngleAxisd(2 * std::numbers::pi * turns / plate.symmetry(), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  const std::vector<Eigen::Vector3d> points = plate.points();
  const std::size_t label = static_cast<std::size_t>(turned_points(plate, turns)[0]);
  result.translation() = points[label] - result.linear() * points[0];
  return result;
}

}  // namespace

void settle_plate_turns(const Plate& plate, std::vector<View>& views,
                        std::vector<RigidTransform>& T_camera_plate) {
  const int symmetry = plate.symmetry();
  if (symmetry == 1) return;
  // Measured against each view in turn; the reference that leaves least disagreement stands.
  double least = std::numeric_limits<double>::infinity();
  std::vector<int> best(views.size(), 0);
  for (std::size_t reference = 0; reference < views.size(); ++reference) {
    std::vector<int> turns(views.size(), 0);
    double sum = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const double wanted =
          angle(views[reference].T_base_tool.linear().transpose() * views[i].T_base_tool.linear());
      double nearest = std::numeric_limits<double>::infinity();
      for (int turn = 0; turn < symmetry; ++turn) {
        const RigidTransform pose = T_camera_plate[i] * turned_plate(plate, turn).inverse();
        const double seen = angle(T_camera_plate[reference].linear().transpose() * pose.linear());
        // Of two turns that fit alike, as square to the axis they may, the first.
        if (std::abs(seen - wanted) < nearest - 1e-9) {
          nearest = std::abs(seen - wanted);
          turns[i] = turn;
        }
      }
      sum += nearest;
    }
    if (sum < least) {
      least = sum;
      best = turns;
    }
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (best[i] == 0) continue;
    const std::vector<int> labels = turned_points(plate, best[i]);
    std::vector<Eigen::Vector2d> target(views[i].target.size());
    for (std::size_t k = 0; k < target.size(); ++k)
      target[static_cast<std::size_t>(labels[k])] = views[i].target[k];
    views[i].target = target;
    T_camera_plate[i] = T_camera_plate[i] * turned_plate(plate, best[i]).inverse();
  }
}

}  // namespace arcstart
