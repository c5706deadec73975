#include "services/calibration/adjustment/adjustment_model.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace arcstart::calibration {

Eigen::Matrix<double, 3, 2> plane_axes(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d along =
      std::abs(normal.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = (along - normal.dot(along) * normal).normalized();
  axes.col(1) = normal.cross(axes.col(0));
  return axes;
}

}  // namespace arcstart::calibration
