#include "services/seam_finding/answer/torch.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "common/xyzwpr.hpp"
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

namespace {

// x along the seam, z out of the joint half-way between its plates' normals, y = z x x.
Eigen::Matrix3d seam_axes(const SeamResult& seam) {
  Eigen::Matrix3d axes;
  const Eigen::Vector3d out = seam.normals[0] + seam.normals[1];
  axes.col(0) = seam.direction;
  axes.col(2) = (out - out.dot(seam.direction) * seam.direction).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

}  // namespace

void set_torch(const SeamFindingSettings& settings, SeamResult& seam) {
  const bool in_one_plane = seam.joint_type == "butt" || seam.joint_type == "v";
  TorchPose torch = torch_at(seam.start, seam.direction, seam.torch_faces,
                             {in_one_plane ? 0 : settings.torch_work_angle_deg * kDegree,
                              settings.torch_travel_angle_deg * kDegree, settings.approach_mm});
  if (settings.torch_wpr_deg.size() == 3) {
    torch.orientation = rotation_from_wpr(settings.torch_wpr_deg[0], settings.torch_wpr_deg[1],
                                          settings.torch_wpr_deg[2]);
    if (torch.orientation.w() < 0) torch.orientation.coeffs() *= -1;
    const Eigen::Vector3d wire = torch.orientation * Eigen::Vector3d::UnitZ();
    for (const Eigen::Vector3d& face : seam.torch_faces)
      if (wire.dot(face) >= 0) {
        seam.torch.reset();
        seam.remarks.push_back({Reason::Code::kTorchThroughPlate});
        return;
      }
    torch.approach = seam.start - settings.approach_mm * wire;
  }
  const Eigen::Vector3d bias = seam_axes(seam) * Eigen::Vector3d(settings.bias_mm.data());
  torch.position += bias;
  torch.approach += bias;
  seam.torch = torch;
}

}  // namespace arcstart::seam_finding
