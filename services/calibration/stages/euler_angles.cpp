#include "services/calibration/stages/euler_angles.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace arcstart::calibration {

Eigen::Matrix3d composed(const EulerOrder& order, const Eigen::Vector3d& angles) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  for (int factor = 0; factor < 3; ++factor)
    rotation = rotation * Eigen::AngleAxisd(
                              angles(factor),
                              Eigen::Vector3d::Unit(order.axes[static_cast<std::size_t>(factor)]));
  return rotation;
}

Eigen::Vector3d euler_angles(const EulerOrder& order, const Eigen::Matrix3d& rotation) {
  Eigen::Vector3d angles = rotation.eulerAngles(order.axes[0], order.axes[1], order.axes[2]);
  const bool proper = order.axes[0] == order.axes[2];
  // The same rotation's other triple.
  const auto other = [](double angle) {
    return angle > 0 ? angle - std::numbers::pi : angle + std::numbers::pi;
  };
  if (proper ? angles.y() < 0 : std::abs(angles.y()) > std::numbers::pi / 2) {
    const double middle =
        proper ? -angles.y() : std::remainder(std::numbers::pi - angles.y(), 2 * std::numbers::pi);
    angles = {other(angles.x()), middle, other(angles.z())};
  }
  return angles;
}

}  // namespace arcstart::calibration
