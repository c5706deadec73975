#include "services/seam_finding/answer/calibration_covariance.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <vector>

namespace arcstart::seam_finding {
namespace {

// The two axes in the laser plane about which its normal is tilted, as the calibration counts them.
Eigen::Vector3d tilt_axis(const Eigen::Vector3d& normal, int which) {
  const Eigen::Vector3d along =
      std::abs(normal.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d first = (along - normal.dot(along) * normal).normalized();
  return which == 0 ? first : Eigen::Vector3d(normal.cross(first));
}

using Change = std::function<void(Calibration&, double)>;

// Of each parameter but the time offset, in the order of the calibration's covariance.
std::vector<Change> changes() {
  std::vector<Change> all;
  for (double SensorModel::*number :
       {&SensorModel::fx, &SensorModel::fy, &SensorModel::cx, &SensorModel::cy})
    all.push_back([number](Calibration& set, double by) { set.sensor_model.*number += by; });
  for (std::size_t i = 0; i < SensorModel{}.distortion.size(); ++i)
    all.push_back([i](Calibration& set, double by) { set.sensor_model.distortion[i] += by; });
  for (const int which : {0, 1})
    all.push_back([which](Calibration& set, double by) {
      Eigen::Vector3d& normal = set.sensor_model.laser_plane.normal;
      normal = (normal + by * tilt_axis(normal, which)).normalized();
    });
  all.push_back([](Calibration& set, double by) { set.sensor_model.laser_plane.offset += by; });
  for (const int axis : {0, 1, 2})
    all.push_back([axis](Calibration& set, double by) {
      const Eigen::AngleAxisd turn(by, Eigen::Vector3d::Unit(axis));
      set.T_tool_camera.linear() = turn.toRotationMatrix() * set.T_tool_camera.linear();
    });
  for (const int axis : {0, 1, 2})
    all.push_back([axis](Calibration& set, double by) {
      set.T_tool_camera.translation() += by * Eigen::Vector3d::Unit(axis);
    });
  return all;
}

// In base.
std::optional<Eigen::Vector3d> place_of(Calibration set, const SeenPoint& point,
                                        const Change& change, double by) {
  change(set, by);
  const auto seen = camera_point(set.sensor_model, point.u, point.v);
  if (!seen) return std::nullopt;
  return point.T_base_tool * (set.T_tool_camera * *seen);
}

}  // namespace

// A parameter is moved by its own deviation: over that the place is as good as linear.
std::optional<Eigen::Matrix3d> calibration_covariance(const Calibration& calibration,
                                                      const SeenPoint& point) {
  using Square =
      Eigen::Matrix<double, Calibration::kParameters, Calibration::kParameters, Eigen::RowMajor>;
  if (calibration.covariance.size() != Square::SizeAtCompileTime) return std::nullopt;
  const Eigen::Map<const Square> covariance(calibration.covariance.data());
  auto derivative = Eigen::Matrix<double, 3, Calibration::kParameters>::Zero().eval();
  int parameter = 0;
  for (const Change& change : changes()) {
    const double step = std::sqrt(covariance(parameter, parameter));
    if (step > 0) {  // else it is known
      const auto up = place_of(calibration, point, change, step);
      const auto down = place_of(calibration, point, change, -step);
      if (!up || !down) return std::nullopt;
      derivative.col(parameter) = (*up - *down) / (2 * step);
    }
    ++parameter;
  }
  derivative.col(parameter) = point.velocity;  // time offset
  const Eigen::Matrix3d result = derivative * covariance * derivative.transpose();
  if (!result.allFinite()) return std::nullopt;
  return result;
}

}  // namespace arcstart::seam_finding
