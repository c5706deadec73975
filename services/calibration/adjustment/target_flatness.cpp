#include "services/calibration/adjustment/target_flatness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "services/calibration/linear_algebra/dense_solvers.hpp"
#include "services/calibration/target/projection.hpp"

namespace arcstart::calibration {

TargetFlatness target_flatness(const Target& plate, const std::vector<View>& views,
                               const AdjustmentState& state) {
  const std::vector<Eigen::Vector3d> points = plate.points();
  const SensorModel& model = state.model;
  const std::array<double, 4> camera{model.fx, model.fy, model.cx, model.cy};
  Eigen::VectorXd along = Eigen::VectorXd::Zero(plate.size()),
                  square = Eigen::VectorXd::Zero(plate.size());
  double residuals = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const TargetInCamera<double> pose{state.T_camera_plate[i].linear(),
                                      state.T_camera_plate[i].translation()};
    for (int k = 0; k < plate.size(); ++k) {
      const auto number = static_cast<std::size_t>(k);
      const auto seen_at = [&](double height) {
        const Eigen::Vector3d point = points[number] - height * Eigen::Vector3d::UnitZ();
        return seen_centre<double>(camera.data(), model.distortion.data(), pose, point,
                                   plate.radius(k));
      };
      constexpr double kStep = 0.01;  // mm
      const Eigen::Vector2d slope = (seen_at(kStep) - seen_at(-kStep)) / (2 * kStep);
      const Eigen::Vector2d residual = views[i].target[number] - seen_at(0);
      along(k) += slope.dot(residual);
      square(k) += slope.squaredNorm();
      residuals += residual.squaredNorm();
    }
  }
  Eigen::MatrixXd plane(plate.size(), 3);
  for (int k = 0; k < plate.size(); ++k)
    plane.row(k) << 1, points[static_cast<std::size_t>(k)].x(),
        points[static_cast<std::size_t>(k)].y();
  Eigen::VectorXd height = along.cwiseQuotient(square.cwiseMax(1e-12));
  height -= plane * least_squares(plane, height);
  TargetFlatness result;
  result.height_mm.assign(height.data(), height.data() + height.size());
  result.bend_mm = height.maxCoeff() - height.minCoeff();
  const double count = 2.0 * static_cast<double>(views.size()) * plate.size();
  result.deviation_mm = std::sqrt(residuals / count / square.mean());
  return result;
}

}  // namespace arcstart::calibration
