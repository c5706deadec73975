#include "services/seam_finding/answer/calibration_covariance.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace arcstart::seam_finding {
namespace {

constexpr int kCamera = 4, kDistortion = 9, kTilt = 11, kOffset = 12, kTurn = 15, kPosition = 18;
// Of the differences: px, 1, rad, mm, rad, mm.
constexpr double kSteps[] = {1e-2, 1e-6, 1e-6, 1e-3, 1e-6, 1e-3};

// The two axes in the laser plane about which its normal is tilted, as the calibration counts them.
Eigen::Vector3d tilt_axis(const Eigen::Vector3d& normal, int which) {
  const Eigen::Vector3d along =
      std::abs(normal.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d first = (along - normal.dot(along) * normal).normalized();
  return which == 0 ? first : Eigen::Vector3d(normal.cross(first));
}

double step_of(int parameter) {
  return kSteps[parameter < kCamera       ? 0
                : parameter < kDistortion ? 1
                : parameter < kTilt       ? 2
                : parameter < kOffset     ? 3
                : parameter < kTurn       ? 4
                                          : 5];
}

// In base, of the set with one parameter changed.
std::optional<Eigen::Vector3d> place_of(const Calibration& calibration, const SeenPoint& point,
                                        int parameter, double change) {
  SensorModel model = calibration.sensor_model;
  RigidTransform T_tool_camera = calibration.T_tool_camera;
  if (parameter < kCamera) {
    double* const camera[] = {&model.fx, &model.fy, &model.cx, &model.cy};
    *camera[parameter] += change;
  } else if (parameter < kDistortion) {
    model.distortion[static_cast<std::size_t>(parameter - kCamera)] += change;
  } else if (parameter < kTilt) {
    Eigen::Vector3d& normal = model.laser_plane.normal;
    normal = (normal + change * tilt_axis(normal, parameter - kDistortion)).normalized();
  } else if (parameter < kOffset) {
    model.laser_plane.offset += change;
  } else if (parameter < kTurn) {
    const Eigen::AngleAxisd turn(change, Eigen::Vector3d::Unit(parameter - kOffset));
    T_tool_camera.linear() = turn.toRotationMatrix() * T_tool_camera.linear();
  } else {
    T_tool_camera.translation() += change * Eigen::Vector3d::Unit(parameter - kTurn);
  }
  const auto seen = camera_point(model, point.u, point.v);
  if (!seen) return std::nullopt;
  return point.T_base_tool * (T_tool_camera * *seen);
}

}  // namespace

std::optional<Eigen::Matrix3d> calibration_covariance(const Calibration& calibration,
                                                      const SeenPoint& point) {
  constexpr int kParameters = Calibration::kParameters;
  if (calibration.covariance.size() != kParameters * kParameters) return std::nullopt;
  Eigen::Matrix<double, 3, kParameters> derivative;
  for (int parameter = 0; parameter < kPosition; ++parameter) {
    const double step = step_of(parameter);
    const auto up = place_of(calibration, point, parameter, step);
    const auto down = place_of(calibration, point, parameter, -step);
    if (!up || !down) return std::nullopt;
    derivative.col(parameter) = (*up - *down) / (2 * step);
  }
  derivative.col(kPosition) = point.velocity;  // time offset
  const Eigen::Map<const Eigen::Matrix<double, kParameters, kParameters, Eigen::RowMajor>>
      covariance(calibration.covariance.data());
  const Eigen::Matrix3d result = derivative * covariance * derivative.transpose();
  if (!result.allFinite()) return std::nullopt;
  return result;
}

}  // namespace arcstart::seam_finding
