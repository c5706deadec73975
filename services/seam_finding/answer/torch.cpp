#include "services/seam_finding/answer/torch.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "services/seam_finding/answer/constants.hpp"

namespace arcstart::seam_finding {

TorchPose torch_at(const Eigen::Vector3d& start, const Eigen::Vector3d& direction,
                   const std::array<Eigen::Vector3d, 2>& normals, const TorchChoice& choice) {
  const int flat = std::abs(normals[0].z()) >= std::abs(normals[1].z()) ? 0 : 1;
  const Eigen::Vector3d& n = normals[flat];
  // In the flatter plate, away from the seam.
  const Eigen::Vector3d along_plate =
      (normals[1 - flat] - normals[1 - flat].dot(n) * n).normalized();
  const double open = M_PI - angle_between(normals[0], normals[1]);
  const double wanted = choice.work_angle > 0 ? choice.work_angle : open / 2;
  const double work =
      std::clamp(wanted, kAnswer.least_torch_share * open, (1 - kAnswer.least_torch_share) * open);
  const Eigen::Vector3d out = std::cos(work) * along_plate + std::sin(work) * n;
  const Eigen::Vector3d wire =
      (-std::cos(choice.travel_angle) * out + std::sin(choice.travel_angle) * direction)
          .normalized();
  Eigen::Matrix3d axes;
  axes.col(2) = wire;
  axes.col(0) = (direction - direction.dot(wire) * wire).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  TorchPose pose;
  pose.position = start;
  pose.orientation = Eigen::Quaterniond(axes);
  if (pose.orientation.w() < 0) pose.orientation.coeffs() *= -1;
  pose.approach = start - choice.approach * wire;
  return pose;
}

}  // namespace arcstart::seam_finding
