#include "services/calibration/stages/scale_consistency.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <cmath>

namespace arcstart::calibration {
namespace {

constexpr double kLeast = 0.003;  // a plate's print or its measuring may err by so much
constexpr double kSure = 5;       // standard deviations
constexpr double kGross = 0.1;

}  // namespace

ScaleConsistency scale_consistency(const std::vector<RigidTransform>& T_base_tool,
                                   const std::vector<RigidTransform>& T_camera_plate,
                                   const Eigen::Matrix3d& hand_eye_rotation) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double squares = 0;
  int equations = 0;
  for (std::size_t i = 0; i < T_base_tool.size(); ++i)
    for (std::size_t j = i + 1; j < T_base_tool.size(); ++j) {
      const RigidTransform a = T_base_tool[j].inverse() * T_base_tool[i],
                           b = T_camera_plate[j] * T_camera_plate[i].inverse();
      // (R_A - I) t_X - factor R_X t_B = -t_A
      Eigen::Matrix<double, 3, 4> left;
      left.leftCols<3>() = a.linear() - Eigen::Matrix3d::Identity();
      left.col(3) = -hand_eye_rotation * b.translation();
      normal += left.transpose() * left;
      right -= left.transpose() * a.translation();
      squares += a.translation().squaredNorm();
      equations += 3;
    }
  const Eigen::Matrix4d inverse = normal.inverse();
  const Eigen::Vector4d solution = inverse * right;
  const double left_over = std::max(0.0, squares - right.dot(solution));
  // Each view stands in many pairs: as many equations are independent as there are views.
  const double independent = 3.0 * static_cast<double>(T_base_tool.size());
  return {solution(3), std::sqrt(left_over / equations * inverse(3, 3) * equations / independent)};
}

std::string length_slip(const ScaleConsistency& scale, const Target& plate) {
  if (std::abs(scale.factor - 1) < std::max(kLeast, kSure * scale.deviation)) return "";
  return fmt::format(
      "robot and plate do not mean the same by a millimetre: the robot's moves fit a pitch_mm of "
      "{:.4g} (within {:.2g}), plate.yaml says {:.4g}: measure the plate; a printer scales, a unit "
      "slips",
      scale.factor * plate.pitch_mm, 2 * scale.deviation * plate.pitch_mm, plate.pitch_mm);
}

bool is_gross(const ScaleConsistency& scale) {
  return std::abs(scale.factor - 1) > std::max(kGross, kSure * scale.deviation);
}

}  // namespace arcstart::calibration
