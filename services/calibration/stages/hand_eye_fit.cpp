#include "services/calibration/stages/hand_eye_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/order_statistics.hpp"
#include "services/calibration/linear_algebra/dense_solvers.hpp"
#include "services/calibration/stages/hand_eye.hpp"
#include "services/calibration/stages/target_symmetry.hpp"

namespace arcstart::calibration {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Moves {
  std::vector<RigidTransform> T_base_tool, T_camera_plate;
};

Moves moves_of(const Target& plate, const std::vector<PairedPose>& poses) {
  Moves moves;
  std::vector<View> views;
  for (const PairedPose& pose : poses) {
    if (!pose.T_camera_plate) continue;
    moves.T_base_tool.push_back(pose.T_base_tool);
    moves.T_camera_plate.push_back(*pose.T_camera_plate);
    views.emplace_back().T_base_tool = pose.T_base_tool;
  }
  settle_target_symmetry(plate, views, moves.T_camera_plate);
  return moves;
}

Eigen::Matrix3d hand_eye_rotation(const Moves& moves) {
  constexpr double kHalfTurn = 175 * kDegree;  // beyond it the axis' sign is chance
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < moves.T_base_tool.size(); ++i)
    for (std::size_t j = i + 1; j < moves.T_base_tool.size(); ++j) {
      const Eigen::AngleAxisd a(Eigen::Matrix3d(moves.T_base_tool[j].linear().transpose() *
                                                moves.T_base_tool[i].linear())),
          b(Eigen::Matrix3d(moves.T_camera_plate[j].linear() *
                            moves.T_camera_plate[i].linear().transpose()));
      if (std::max(a.angle(), b.angle()) > kHalfTurn) continue;
      sum += a.angle() * a.axis() * (b.angle() * b.axis()).transpose();
    }
  return nearest_rotation(sum);
}

std::vector<double> misfits(const Target& plate, const Moves& moves, const HandEyeFit& fit) {
  const std::vector<Eigen::Vector3d> points = plate.points();
  std::vector<double> result;
  for (std::size_t i = 0; i < moves.T_base_tool.size(); ++i) {
    RigidTransform tool = moves.T_base_tool[i];
    tool.translation() /= fit.factor;
    const RigidTransform carried = tool * fit.T_tool_camera * moves.T_camera_plate[i];
    double squares = 0;
    for (const Eigen::Vector3d& point : points)
      squares += (carried * point - fit.T_base_plate * point).squaredNorm();
    const double rms = std::sqrt(squares / static_cast<double>(points.size()));
    result.push_back(std::isfinite(rms) ? rms : kInfinite);
  }
  return result;
}

// Over all moves given; nothing where they leave the position open.
std::optional<HandEyeFit> least_squares_fit(const Moves& moves, std::optional<double> factor) {
  const auto n = static_cast<Eigen::Index>(moves.T_base_tool.size());
  const Eigen::Matrix3d rotation = hand_eye_rotation(moves);
  // R_i t_X + factor R_i R_X t_Bi + t_i = t_Z, less its mean over the poses.
  Eigen::MatrixXd left(3 * n, 4);
  Eigen::VectorXd right(3 * n);
  Eigen::Matrix<double, 3, 4> left_mean = Eigen::Matrix<double, 3, 4>::Zero();
  Eigen::Vector3d right_mean = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const RigidTransform& tool = moves.T_base_tool[at];
    left.block<3, 3>(3 * i, 0) = tool.linear();
    left.block<3, 1>(3 * i, 3) =
        tool.linear() * (rotation * moves.T_camera_plate[at].translation());
    right.segment<3>(3 * i) = -tool.translation();
    left_mean += left.middleRows<3>(3 * i) / static_cast<double>(n);
    right_mean += right.segment<3>(3 * i) / static_cast<double>(n);
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    left.middleRows<3>(3 * i) -= left_mean;
    right.segment<3>(3 * i) -= right_mean;
  }
  HandEyeFit fit;
  Eigen::Vector3d position;  // in the robot's unit
  if (factor) {
    fit.factor = *factor;
    position = least_squares(left.leftCols<3>(), right - *factor * left.col(3));
  } else {
    const Eigen::Vector4d solution = least_squares(left, right);
    const Eigen::Matrix4d inverse = (left.transpose() * left).inverse();
    const double freedom = std::max(1.0, static_cast<double>(3 * n - 7));
    fit.factor = solution(3);
    fit.deviation = std::sqrt((right - left * solution).squaredNorm() / freedom * inverse(3, 3));
    position = solution.head<3>();
  }
  if (!std::isfinite(fit.factor) || fit.factor == 0 || !position.allFinite()) return std::nullopt;
  fit.T_tool_camera.linear() = rotation;
  fit.T_tool_camera.translation() = position / fit.factor;
  std::vector<RigidTransform> tools = moves.T_base_tool;
  for (RigidTransform& tool : tools) tool.translation() /= fit.factor;
  fit.T_base_plate = mean_plate(tools, fit.T_tool_camera, moves.T_camera_plate);
  return fit;
}

}  // namespace

HandEyeFit fit_hand_eye(const Target& plate, const std::vector<PairedPose>& poses,
                        std::optional<double> factor) {
  constexpr int kRounds = 3;
  constexpr double kFar = 2;  // times the median: not of those that agree
  const Moves moves = moves_of(plate, poses);
  HandEyeFit best;
  best.misfit_mm = kInfinite;
  if (moves.T_base_tool.size() < 3) return best;
  Moves agreeing = moves;
  for (int round = 0; round < kRounds; ++round) {
    auto fit = least_squares_fit(agreeing, factor);
    if (!fit) break;
    const std::vector<double> all = misfits(plate, moves, *fit);
    fit->misfit_mm = median(std::vector(all));
    if (!(fit->misfit_mm < best.misfit_mm)) break;
    best = *fit;
    agreeing = {};
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i] > kFar * fit->misfit_mm) continue;
      agreeing.T_base_tool.push_back(moves.T_base_tool[i]);
      agreeing.T_camera_plate.push_back(moves.T_camera_plate[i]);
    }
  }
  return best;
}

}  // namespace arcstart::calibration
