#include "services/calibration/stages/target_symmetry.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace arcstart::calibration {
namespace {

double angle(const Eigen::Matrix3d& rotation) { return Eigen::AngleAxisd(rotation).angle(); }

// The plate turned about its middle, as a transform of its points.
RigidTransform turned_plate(const Target& plate, int turns) {
  RigidTransform result = RigidTransform::Identity();
  result.linear() =
      Eigen::AngleAxisd(2 * std::numbers::pi * turns / plate.symmetry(), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  const std::vector<Eigen::Vector3d> points = plate.points();
  const std::size_t label = static_cast<std::size_t>(turned_points(plate, turns)[0]);
  result.translation() = points[label] - result.linear() * points[0];
  return result;
}

// How far the camera's turn between two views is from the robot's; rad.
class Disagreement {
 public:
  Disagreement(const Target& plate, const std::vector<View>& views,
               const std::vector<RigidTransform>& T_camera_plate)
      : views_(views), seen_(T_camera_plate) {
    for (int turn = 0; turn < plate.symmetry(); ++turn)
      unturned_.push_back(turned_plate(plate, turn).inverse().linear());
  }
  double operator()(std::size_t i, int turn_i, std::size_t j, int turn_j) const {
    const Eigen::Matrix3d a = seen_[i].linear() * unturned_[static_cast<std::size_t>(turn_i)],
                          b = seen_[j].linear() * unturned_[static_cast<std::size_t>(turn_j)];
    return std::abs(angle(a.transpose() * b) - angle(views_[i].T_base_tool.linear().transpose() *
                                                     views_[j].T_base_tool.linear()));
  }

 private:
  const std::vector<View>& views_;
  const std::vector<RigidTransform>& seen_;
  std::vector<Eigen::Matrix3d> unturned_;
};

// The turn of a view that agrees best with the others as they are turned now, -1 for those not
// known. A single pair often cannot tell: turned by a right angle, both ways round look alike. Each
// pair counts up to half a radian, so that a wrong pose does not settle the others.
int best_turn(const Disagreement& disagreement, const std::vector<int>& turns, std::size_t view,
              int symmetry, double& least) {
  int best = 0;
  least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < symmetry; ++turn) {
    double sum = 0;
    for (std::size_t i = 0; i < turns.size(); ++i)
      if (i != view && turns[i] >= 0) sum += std::min(0.5, disagreement(i, turns[i], view, turn));
    if (sum < least - 1e-12) {
      least = sum;
      best = turn;
    }
  }
  return best;
}

// All settled by one view alone, then each by all the others until nothing changes. What is left of
// the disagreement, over all pairs.
double settle_from(const Disagreement& disagreement, std::size_t first, int symmetry,
                   std::vector<int>& turns) {
  constexpr int kRounds = 20;
  std::vector<int> start(turns.size(), -1);
  start[first] = 0;
  turns = start;
  double ignored = 0, sum = 0;
  for (std::size_t i = 0; i < turns.size(); ++i)
    if (i != first) turns[i] = best_turn(disagreement, start, i, symmetry, ignored);
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    sum = 0;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      double least = 0;
      const int turn = i == first ? 0 : best_turn(disagreement, turns, i, symmetry, least);
      changed = changed || turn != turns[i];
      turns[i] = turn;
      sum += least;
    }
    if (!changed) break;
  }
  return sum;
}

}  // namespace

void settle_target_symmetry(const Target& plate, std::vector<View>& views,
                            std::vector<RigidTransform>& T_camera_plate) {
  const int symmetry = plate.symmetry();
  if (symmetry == 1) return;
  const Disagreement disagreement(plate, views, T_camera_plate);
  double least = std::numeric_limits<double>::infinity();
  std::vector<int> best(views.size(), 0), turns(views.size(), 0);
  for (std::size_t first = 0; first < views.size(); ++first)
    if (const double sum = settle_from(disagreement, first, symmetry, turns); sum < least) {
      least = sum;
      best = turns;
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

}  // namespace arcstart::calibration
