#include <algorithm>
#include <cmath>
#include <limits>

#include "services/calibration/linear_algebra/dense_solvers.hpp"
#include "services/calibration/stages/hand_eye_fit.hpp"

namespace arcstart::calibration {
namespace {

using SpacePoints = std::vector<Eigen::Vector3d>;

// A point fixed to the camera, seen from the plate.
SpacePoints seen_from_plate(const std::vector<RigidTransform>& T_plate_camera,
                            const Eigen::Vector3d& point) {
  SpacePoints points;
  for (const RigidTransform& pose : T_plate_camera) points.push_back(pose * point);
  return points;
}

Eigen::Vector3d mean_of(const SpacePoints& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point / static_cast<double>(points.size());
  return sum;
}

// Where the plate lies, that points seen from it come to lie as said: Procrustes.
Eigen::Matrix3d turn_between(const SpacePoints& seen, const SpacePoints& said) {
  const Eigen::Vector3d seen_mean = mean_of(seen), said_mean = mean_of(said);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < seen.size(); ++i)
    sum += (said[i] - said_mean) * (seen[i] - seen_mean).transpose();
  return nearest_rotation(sum);
}

// Gauss and Newton over the plate's turn and the point, from that point on; RMS at the end.
double fit_from(const std::vector<RigidTransform>& T_plate_camera, const SpacePoints& said,
                Eigen::Vector3d point) {
  constexpr int kRounds = 30;
  const auto n = static_cast<Eigen::Index>(said.size());
  const Eigen::Vector3d said_mean = mean_of(said);
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const SpacePoints seen = seen_from_plate(T_plate_camera, point);
    const Eigen::Vector3d seen_mean = mean_of(seen);
    const Eigen::Matrix3d turn = turn_between(seen, said);
    Eigen::MatrixXd jacobian(3 * n, 6);  // of a small turn, and of the point
    Eigen::VectorXd residual(3 * n);
    Eigen::Matrix3d turned_mean = Eigen::Matrix3d::Zero();
    for (const RigidTransform& pose : T_plate_camera)
      turned_mean += pose.linear() / static_cast<double>(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Eigen::Vector3d q = turn * (seen[at] - seen_mean);
      residual.segment<3>(3 * i) = q - (said[at] - said_mean);
      jacobian.block<3, 3>(3 * i, 0) << 0, q.z(), -q.y(), -q.z(), 0, q.x(), q.y(), -q.x(), 0;
      jacobian.block<3, 3>(3 * i, 3) = turn * (T_plate_camera[at].linear() - turned_mean);
    }
    const double rms = std::sqrt(residual.squaredNorm() / static_cast<double>(n));
    if (!(rms < best - 1e-6)) break;
    best = rms;
    point -= least_squares(jacobian, residual).tail<3>();
  }
  return best;
}

}  // namespace

std::optional<double> position_misfit(const std::vector<PairedPose>& poses) {
  constexpr std::size_t kFewest = 8;  // 24 numbers for the nine that are sought
  std::vector<RigidTransform> T_plate_camera;
  SpacePoints said;
  for (const PairedPose& pose : poses) {
    if (!pose.T_camera_plate) continue;
    T_plate_camera.push_back(pose.T_camera_plate->inverse());
    said.push_back(pose.T_base_tool.translation());
  }
  if (said.size() < kFewest) return std::nullopt;
  constexpr double kReach = 250;  // mm from the camera, where tools are; a start is all that it is
  double best = std::numeric_limits<double>::infinity();
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        best = std::min(best, fit_from(T_plate_camera, said, kReach * Eigen::Vector3d(x, y, z)));
  return best;
}

}  // namespace arcstart::calibration
